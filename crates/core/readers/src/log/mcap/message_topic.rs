//! Messages of one kind, as rows of a topic.

use std::sync::Arc;

use super::decode::Decoder;
use super::schema::Schema;
use super::units::units_of;
use super::words::SchemaMeaning;
use crate::log::growing::{FieldStep, GrowingTable, Path, Room, ValuePlace};
use crate::log::{FieldKind, Log, TopicName};

/// Topic of messages of one name, encoding and schema.
pub(super) struct MessageTopic {
    name: String,
    encoding: String,
    schema: Option<Arc<Schema>>,
    decoder: Decoder,
    table: GrowingTable,
    /// Place that the time of publishing goes to.
    published: ValuePlace,
    meaning: SchemaMeaning,
    /// Messages that could not be read, and why the first of them could not.
    failed: Option<(u64, &'static str)>,
}

impl MessageTopic {
    /// A new topic of the log.
    pub fn new(name: &str, encoding: &str, schema: Option<Arc<Schema>>, log: &mut Log) -> Self {
        let mut topic_name = TopicName::single(name);
        while log.place(&topic_name).is_some() {
            topic_name.instance = Some(topic_name.instance.map_or(1, |instance| instance + 1));
        }
        let place = log.topic_or_new(&topic_name, Vec::new);
        let schema_name = schema.as_ref().map_or("", |schema| schema.name.as_str());
        schema_name.clone_into(&mut log.topics[place].schema);
        let (decoder, unknown) = Decoder::new(encoding, schema.as_deref());
        if let Some(cause) = unknown.filter(|_| !encoding.is_empty()) {
            log.report.remark(format!(
                "{topic_name}: only times and lengths of its messages are kept: {cause}"
            ));
        }
        Self {
            name: name.to_owned(),
            encoding: encoding.to_owned(),
            decoder,
            table: GrowingTable::new(place, units_of(schema_name)),
            published: ValuePlace::New,
            meaning: SchemaMeaning::of(schema_name),
            schema,
            failed: None,
        }
    }

    /// Whether messages of a channel belong here.
    pub fn is_for(&self, name: &str, encoding: &str, schema: Option<&Schema>) -> bool {
        self.name == name && self.encoding == encoding && self.schema.as_deref() == schema
    }

    /// Takes a message with the times at which it was logged and published, seconds. The error says why it is
    /// none of its schema.
    pub fn store(
        &mut self,
        [logged, published]: [f64; 2],
        data: &[u8],
        room: &mut Room,
        log: &mut Log,
    ) -> Result<(), &'static str> {
        self.table.clear(room, log);
        let mut stored = self.decoder.decode(data, &mut self.table);
        if stored.is_ok() {
            if published != logged {
                let root = Path::default();
                let path = root.then(FieldStep::Name("publish_time"));
                let bytes = published.to_le_bytes();
                self.table
                    .number(&mut self.published, &path, FieldKind::F64, &bytes);
            }
            if !self.table.store(logged, room, log) {
                stored = Err("a message takes far more room than it has bytes");
            }
        }
        if let Err(cause) = stored {
            self.failed.get_or_insert((0, cause)).0 += 1;
            return Err(cause);
        }
        self.meaning.tell(self.table.topic(), log);
        Ok(())
    }

    /// Says what was left out.
    pub fn tell(&mut self, log: &mut Log) {
        let name = log.topics[self.table.topic()].name.clone();
        if let Some(what) = self.table.left_out.take() {
            log.report.remark(format!("{name}: left out: {what}"));
        }
        if let Some((count, cause)) = self.failed.take() {
            let messages = if count == 1 { "message" } else { "messages" };
            log.report.remark(format!(
                "{name}: {count} {messages} could not be read: {cause}"
            ));
        }
    }
}
