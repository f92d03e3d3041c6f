//! The bytes that go between page and workers. They carry no names, so that every field has to be written: one that is
//! left out when it is empty cannot be read back.

use postcard::{Error, from_bytes, take_from_bytes, to_stdvec};

use super::{JobEvent, JobId, Reply, Request};

/// Place of [`Reply::Event`] among the variants, which begins its bytes.
const EVENT: u32 = 0;

impl Request {
    /// As bytes for a worker.
    ///
    /// # Errors
    /// If a part of it cannot be written.
    pub fn to_bytes(&self) -> Result<Vec<u8>, Error> {
        to_stdvec(self)
    }

    /// Decodes a request that [`Self::to_bytes`] wrote.
    ///
    /// # Errors
    /// If the bytes are not those of a request.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        from_bytes(bytes)
    }
}

impl Reply {
    /// As bytes for the page; an event that cannot be written becomes the failure of its job.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let failed = |cause| match self {
            Self::Event(id, _) => to_stdvec(&lost(*id, &cause)).unwrap_or_default(),
            Self::Alive => Vec::new(),
        };
        to_stdvec(self).unwrap_or_else(failed)
    }

    /// Decodes a reply that [`Self::to_bytes`] wrote; an event that cannot be read becomes the failure of its
    /// job, so that nobody waits for it in vain. `None` if not even its job can be read.
    ///
    /// ```
    /// use pilotage_jobs::{JobEvent, Reply};
    ///
    /// let bytes = Reply::Event(700, JobEvent::Progress(0.5, "Flying".to_owned())).to_bytes();
    /// let lost = Reply::from_bytes(&bytes[..bytes.len() - 2]);
    /// let Some(Reply::Event(job, JobEvent::Failed(why))) = lost else { return Err("it was read") };
    /// assert!(job == 700 && why.contains("did not reach the page"));
    /// assert_eq!(Reply::from_bytes(&[]), None);
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn from_bytes(bytes: &[u8]) -> Option<Self> {
        match from_bytes(bytes) {
            Ok(reply) => Some(reply),
            Err(cause) => match take_from_bytes::<(u32, JobId)>(bytes) {
                Ok(((EVENT, id), _)) => Some(lost(id, &cause)),
                _ => None,
            },
        }
    }
}

/// The end of a job whose event was lost on the way.
fn lost(id: JobId, cause: &Error) -> Reply {
    let why =
        format!("What was found did not reach the page ({cause}). This is a fault of the program.");
    Reply::Event(id, JobEvent::Failed(why))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{EncodedPicture, FlightSource, FramePictureOrder, Job, PictureForm};

    #[test]
    fn what_cannot_be_read_fails_its_job() {
        let reply = Reply::Event(700, JobEvent::Progress(0.5, "Flying".into()));
        let mut bytes = reply.to_bytes();
        assert_eq!(Reply::from_bytes(&bytes), Some(reply));
        bytes.truncate(bytes.len() - 2);
        let Some(Reply::Event(700, JobEvent::Failed(why))) = Reply::from_bytes(&bytes) else {
            panic!("{:?}", Reply::from_bytes(&bytes));
        };
        assert!(why.contains("did not reach the page"), "{why}");
        assert_eq!(Reply::from_bytes(&[]), None);
        assert_eq!(
            Reply::from_bytes(&Reply::Alive.to_bytes()),
            Some(Reply::Alive)
        );
    }

    #[test]
    fn pictures_survive_the_way_between_page_and_worker() {
        let told = JobEvent::FramePicture {
            index: 3,
            width: 8,
            pixels: (0..=255).collect(),
        };
        let reply = Reply::Event(1, told);
        assert_eq!(Reply::from_bytes(&reply.to_bytes()), Some(reply));
        let order = FramePictureOrder {
            flight: FlightSource::Nothing,
            index: 3,
            form: PictureForm::PixelsOf(EncodedPicture(vec![1, 2, 3])),
        };
        let request = Request::Start(2, Job::FramePicture(order));
        let sent = request.to_bytes().unwrap();
        assert_eq!(Request::from_bytes(&sent).unwrap(), request);
    }
}
