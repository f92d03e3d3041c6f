//! Messages as their schemas say.

mod definition;
mod descriptor;
mod json;
mod protobuf;
mod ros;
mod varint;
mod wire;

use super::schema::Schema;
use crate::log::FieldKind;
use crate::log::growing::{FieldStep, GrowingTable, Path, ValuePlace};

/// Puts what a message says into the row of a table.
pub(super) struct Decoder {
    form: MessageEncoding,
    /// Place that the message goes to.
    root: ValuePlace,
}

enum MessageEncoding {
    Json,
    Ros(ros::Ros),
    Protobuf(protobuf::Protobuf),
    /// Not known: all that can be told of a message is how long it is.
    Unknown,
}

impl Decoder {
    /// The decoder of messages in `encoding` after `schema`, and why it can tell no more than their length if
    /// it cannot.
    pub fn new(encoding: &str, schema: Option<&Schema>) -> (Self, Option<String>) {
        let described = schema.map_or("", |schema| &schema.encoding);
        let form = match (encoding, described, schema) {
            // The messages themselves say what they hold.
            ("json", "jsonschema" | "", _) => Ok(MessageEncoding::Json),
            ("ros1", "ros1msg", Some(schema)) => {
                ros::Ros::first(&schema.name, &schema.data).map(MessageEncoding::Ros)
            }
            ("cdr", "ros2msg", Some(schema)) => {
                ros::Ros::second(&schema.name, &schema.data).map(MessageEncoding::Ros)
            }
            ("protobuf", "protobuf", Some(schema)) => {
                protobuf::Protobuf::new(&schema.name, &schema.data).map(MessageEncoding::Protobuf)
            }
            _ => Err(format!(
                "messages encoded as \"{encoding}\" with a schema in \"{described}\" are not known here"
            )),
        };
        let (form, cause) = match form {
            Ok(form) => (form, None),
            Err(cause) => (MessageEncoding::Unknown, Some(cause)),
        };
        let root = ValuePlace::New;
        (Self { form, root }, cause)
    }

    /// Puts what the message says into the row. The error says why it is none of its schema.
    pub fn decode(&mut self, data: &[u8], table: &mut GrowingTable) -> Result<(), &'static str> {
        let root = &mut self.root;
        match &self.form {
            MessageEncoding::Json => json::decode(data, root, table),
            MessageEncoding::Ros(ros) => ros.decode(data, root, table),
            MessageEncoding::Protobuf(protobuf) => protobuf.decode(data, root, table),
            MessageEncoding::Unknown => {
                let length = u32::try_from(data.len()).unwrap_or(u32::MAX).to_le_bytes();
                let path = Path::default();
                let path = path.then(FieldStep::Name("bytes"));
                table.number(root, &path, FieldKind::U32, &length);
                Ok(())
            }
        }
    }
}
