//! Readers that go from message to message over whatever bytes have come so far.

use super::{Log, LogReader};

/// Bytes that are put beside those that wait at one time: what a reader copies stays small.
const PIECE: usize = 1 << 16;

/// Result of looking at the bytes that are there.
pub(super) enum LogStep {
    /// They tell nothing until more have come.
    Wait,
    /// The first so many are done with, at least one.
    Took(usize),
}

/// The part of a reader that knows its format.
///
/// A step must depend on nothing but the bytes from its place on, as far as it looks at them: then a
/// log reads the same in whatever pieces it comes.
pub(super) trait LogSteps: Send {
    /// Looks at the `bytes` from the place `offset` of the file on, which are never none. Where
    /// `over`, no more will come, and waiting is no answer.
    fn step(&mut self, bytes: &[u8], offset: u64, over: bool, log: &mut Log) -> LogStep;

    /// The file is over and every byte was taken.
    fn end(&mut self, _log: &mut Log) {}
}

/// A reader made of [`LogSteps`].
#[derive(Default)]
pub(super) struct Stepping<S> {
    steps: S,
    /// Bytes that came and are not done with, behind `done` bytes that are.
    waiting: Vec<u8>,
    done: usize,
    /// Place in the file of the first byte not done with.
    offset: u64,
}

impl<S: LogSteps> Stepping<S> {
    fn walk(&mut self, over: bool, log: &mut Log) {
        while self.done < self.waiting.len() {
            let bytes = &self.waiting[self.done..];
            let took = match self.steps.step(bytes, self.offset, over, log) {
                LogStep::Took(count) => count.clamp(1, bytes.len()),
                LogStep::Wait if over => {
                    let rest = bytes.len();
                    log.report
                        .skip(self.offset, rest as u64, "the file ends too early");
                    rest
                }
                LogStep::Wait => return,
            };
            self.done += took;
            self.offset += took as u64;
        }
    }

    fn make_room(&mut self) {
        // Moves each byte about once, however small the pieces are.
        if self.done >= self.waiting.len() - self.done {
            self.waiting.drain(..self.done);
            self.done = 0;
        }
    }
}

impl<S: LogSteps> LogReader for Stepping<S> {
    fn feed(&mut self, bytes: &[u8], log: &mut Log) {
        for piece in bytes.chunks(PIECE) {
            self.make_room();
            self.waiting.extend_from_slice(piece);
            log.report.bytes += piece.len() as u64;
            self.walk(false, log);
        }
    }

    fn finish(&mut self, log: &mut Log) {
        self.walk(true, log);
        self.waiting = Vec::new();
        self.done = 0;
        self.steps.end(log);
    }
}

#[cfg(test)]
mod tests {
    use super::super::LogFormat;
    use super::*;

    /// Messages of one byte that tells how many follow; nine is no length.
    #[derive(Default)]
    struct Counted {
        ended: bool,
    }

    impl LogSteps for Counted {
        fn step(&mut self, bytes: &[u8], offset: u64, _over: bool, log: &mut Log) -> LogStep {
            let length = 1 + usize::from(bytes[0]);
            if length > 9 {
                log.report.skip(offset, 1, "no length");
                return LogStep::Took(1);
            }
            if bytes.len() < length {
                return LogStep::Wait;
            }
            log.report.message(length);
            LogStep::Took(length)
        }

        fn end(&mut self, _log: &mut Log) {
            self.ended = true;
        }
    }

    fn read(file: &[u8], piece: usize) -> (Log, Stepping<Counted>) {
        let mut log = Log::new("a.bin", LogFormat::Ulog);
        let mut reader = Stepping::<Counted>::default();
        for bytes in file.chunks(piece) {
            reader.feed(bytes, &mut log);
        }
        reader.finish(&mut log);
        (log, reader)
    }

    #[test]
    fn messages_are_the_same_in_pieces_of_any_size() {
        let file = [2, 7, 7, 0, 99, 98, 3, 1, 1, 1, 0, 4, 0];
        let (whole, reader) = read(&file, file.len());
        assert_eq!(whole.report.messages, 4);
        assert_eq!((whole.report.bytes, whole.report.skipped_places), (13, 2));
        assert_eq!(whole.report.skipped[1].offset, 11);
        assert!(reader.steps.ended);
        for piece in 1..file.len() {
            assert_eq!(read(&file, piece).0.report, whole.report);
        }
    }

    #[test]
    fn what_is_done_with_is_given_back() {
        let mut log = Log::new("a.bin", LogFormat::Ulog);
        let mut reader = Stepping::<Counted>::default();
        for _ in 0..100 {
            reader.feed(&[3; 4 * 1024], &mut log);
        }
        assert_eq!(log.report.messages, 100 * 1024);
        assert!(reader.waiting.capacity() < 32 * 1024);
    }
}
