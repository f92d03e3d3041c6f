//! Schemas, channels, and the messages that they describe.

use std::collections::HashMap;
use std::sync::Arc;

use super::message_topic::MessageTopic;
use super::record::{MESSAGE_HEAD, McapMessage, Record};
use super::schema::Schema;
use crate::log::growing::Room;
use crate::log::{Fact, Log};

/// Bytes of messages that are kept until their channel is described: where the description was lost, the summary
/// at the end of the file has it again.
const MOST_WAITING: usize = 64 << 20;
/// The year 2000 in nanoseconds since 1970: what is earlier is no time of the day.
const YEAR_2000: u64 = 946_684_800_000_000_000;

#[derive(Clone, Debug, PartialEq, Eq)]
struct McapChannel {
    schema: u16,
    topic: String,
    encoding: String,
}

/// A message that waits for its channel.
struct Waiting {
    logged: u64,
    published: u64,
    data: Vec<u8>,
}

/// Schemas and channels described so far, and the messages read by them.
#[derive(Default)]
pub(super) struct McapContents {
    schemas: HashMap<u16, Arc<Schema>>,
    channels: HashMap<u16, McapChannel>,
    topics: Vec<MessageTopic>,
    /// Index of the topic that the messages of a channel go to.
    places: HashMap<u16, usize>,
    waiting: HashMap<u16, Vec<Waiting>>,
    waiting_bytes: usize,
    /// When the log begins, nanoseconds.
    zero: Option<u64>,
    room: Room,
    /// Messages of this file, and how many it says that it has.
    messages: u64,
    said: Option<u64>,
}

impl McapContents {
    /// Takes a record. The error says why it cannot be.
    pub fn take(&mut self, record: Record, log: &mut Log) -> Result<(), &'static str> {
        match record {
            Record::Header { profile, library } => {
                for (name, text) in [("profile", profile), ("library", library)] {
                    if !text.is_empty() {
                        add_fact(name, text, log);
                    }
                }
            }
            Record::Schema {
                number,
                name,
                encoding,
                data,
            } => {
                let schema = Schema {
                    name: name.to_owned(),
                    encoding: encoding.to_owned(),
                    data: data.to_vec(),
                };
                self.add_schema(number, schema, log);
            }
            Record::Channel {
                number,
                schema,
                topic,
                encoding,
            } => {
                let channel = McapChannel {
                    schema,
                    topic: topic.to_owned(),
                    encoding: encoding.to_owned(),
                };
                self.add_channel(number, channel, log);
            }
            Record::Message(message) => return self.message(message, log),
            Record::Statistics { messages } => self.said = Some(messages),
            Record::Metadata { name, pairs } => {
                for (key, text) in pairs {
                    add_fact(&format!("{name}: {key}"), text, log);
                }
            }
            Record::Footer { .. } | Record::DataEnd { .. } | Record::Index => {}
        }
        Ok(())
    }

    fn add_schema(&mut self, number: u16, schema: Schema, log: &mut Log) {
        // The number of no schema.
        if number == 0 || self.schemas.get(&number).is_some_and(|old| **old == schema) {
            return;
        }
        self.schemas.insert(number, Arc::new(schema));
        let channels = self
            .channels
            .iter()
            .filter(|(_, channel)| channel.schema == number);
        let mut channels: Vec<u16> = channels.map(|(number, _)| *number).collect();
        channels.sort_unstable();
        for channel in channels {
            self.places.remove(&channel);
            self.deliver(channel, log);
        }
    }

    fn add_channel(&mut self, number: u16, channel: McapChannel, log: &mut Log) {
        if self.channels.get(&number) == Some(&channel) {
            return;
        }
        self.channels.insert(number, channel);
        self.places.remove(&number);
        self.deliver(number, log);
    }

    /// Whether the messages of a channel can be read.
    pub fn is_described(&self, channel: u16) -> bool {
        let channel = self.channels.get(&channel);
        channel.is_some_and(|c| c.schema == 0 || self.schemas.contains_key(&c.schema))
    }

    fn message(&mut self, message: McapMessage, log: &mut Log) -> Result<(), &'static str> {
        if self.zero.is_none() {
            self.zero = Some(message.logged);
            if message.logged > YEAR_2000 {
                log.utc_at_zero = Some(message.logged as f64 / 1e9);
            }
        }
        self.room.offer(MESSAGE_HEAD + message.data.len());
        if let Some(place) = self.place(message.channel, log) {
            return self.store(place, message, log);
        }
        if self.waiting_bytes + message.data.len() > MOST_WAITING {
            return Err("a message of a channel that is described nowhere");
        }
        // So many bytes a message takes beside its own.
        self.waiting_bytes += size_of::<Waiting>() + message.data.len();
        self.waiting
            .entry(message.channel)
            .or_default()
            .push(Waiting {
                logged: message.logged,
                published: message.published,
                data: message.data.to_vec(),
            });
        Ok(())
    }

    /// Index of the topic that the messages of a channel go to; `None` while they cannot be read.
    fn place(&mut self, number: u16, log: &mut Log) -> Option<usize> {
        if let Some(place) = self.places.get(&number) {
            return Some(*place);
        }
        if !self.is_described(number) {
            return None;
        }
        let channel = self.channels.get(&number)?;
        let schema = self.schemas.get(&channel.schema).cloned();
        let fits = |topic: &MessageTopic| {
            topic.is_for(&channel.topic, &channel.encoding, schema.as_deref())
        };
        let place = self.topics.iter().position(fits).unwrap_or_else(|| {
            let topic = MessageTopic::new(&channel.topic, &channel.encoding, schema, log);
            self.topics.push(topic);
            self.topics.len() - 1
        });
        self.places.insert(number, place);
        Some(place)
    }

    fn store(
        &mut self,
        place: usize,
        message: McapMessage,
        log: &mut Log,
    ) -> Result<(), &'static str> {
        let since = |time: u64| {
            let zero = i128::from(self.zero.unwrap_or_default());
            (i128::from(time) - zero) as f64 / 1e9
        };
        let times = [since(message.logged), since(message.published)];
        self.topics[place].store(times, message.data, &mut self.room, log)?;
        self.messages += 1;
        log.report.messages += 1;
        Ok(())
    }

    /// Takes the messages that waited for the description of their channel.
    fn deliver(&mut self, number: u16, log: &mut Log) {
        if !self.is_described(number) {
            return;
        }
        for waiting in self.waiting.remove(&number).unwrap_or_default() {
            self.waiting_bytes -= size_of::<Waiting>() + waiting.data.len();
            let message = McapMessage {
                channel: number,
                logged: waiting.logged,
                published: waiting.published,
                data: &waiting.data,
            };
            let stored = self
                .place(number, log)
                .map(|place| self.store(place, message, log));
            if let Some(Err(cause)) = stored {
                log.report
                    .remark(format!("a message was left out: {cause}"));
            }
        }
    }

    /// Another file begins: what was described holds no more.
    pub fn forget(&mut self, log: &mut Log) {
        self.end(log);
        let zero = self.zero;
        let topics = std::mem::take(&mut self.topics);
        let room = std::mem::take(&mut self.room);
        *self = Self {
            topics,
            zero,
            room,
            ..Self::default()
        };
    }

    /// The file is over.
    pub fn end(&mut self, log: &mut Log) {
        let mut numbers: Vec<u16> = self.waiting.keys().copied().collect();
        numbers.sort_unstable();
        for number in numbers {
            log.report.remark(format!(
                "channel {number} is described nowhere: of its messages only times and lengths are kept"
            ));
            let channel = McapChannel {
                schema: 0,
                topic: format!("channel {number}"),
                encoding: String::new(),
            };
            self.add_channel(number, channel, log);
        }
        for topic in &mut self.topics {
            topic.tell(log);
        }
        if let Some(said) = self.said.take().filter(|said| *said != self.messages) {
            log.report.remark(format!(
                "the file says that it has {said} messages; {} could be read",
                self.messages
            ));
        }
    }
}

fn add_fact(name: &str, text: &str, log: &mut Log) {
    let fact = Fact {
        name: name.to_owned(),
        text: text.to_owned(),
    };
    if !log.facts.contains(&fact) {
        log.facts.push(fact);
    }
}
