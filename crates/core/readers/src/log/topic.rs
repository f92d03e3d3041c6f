//! A topic: rows of one kind with their times.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::{FieldLayout, Rows, schema};

/// Name of a topic: `GPS`, or `GPS` of the second receiver.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct TopicName {
    /// Name of the kind of row.
    pub name: String,
    /// Number of the sensor or sender among several, where the log tells them apart.
    pub instance: Option<u32>,
}

impl TopicName {
    /// The topic of the only instance.
    pub fn single(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            instance: None,
        }
    }
}

impl fmt::Display for TopicName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.instance {
            Some(instance) => write!(f, "{}[{instance}]", self.name),
            None => f.write_str(&self.name),
        }
    }
}

/// Rows of one kind in the order of the file, with their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Topic {
    /// Name of the topic.
    pub name: TopicName,
    /// Name of the kind of message that its rows are, where the log tells that beside the topic's own name
    /// (`sensor_msgs/msg/Imu`), or empty.
    pub schema: String,
    /// Its fields, in the order of the file.
    pub fields: Vec<FieldLayout>,
    /// Time of each row, seconds in the log's time base. As the file has them: they may stand still or
    /// go back.
    pub times: Vec<f64>,
    /// The rows.
    pub rows: Rows,
}

impl Topic {
    /// A topic without rows; a row is as long as its last field reaches.
    ///
    /// ```
    /// use pilotage_readers::log::{FieldKind, FieldLayout, Topic, TopicName};
    ///
    /// let fields = vec![FieldLayout::plain("Alt", FieldKind::U16, 0)];
    /// let mut topic = Topic::new(TopicName::single("BARO"), fields);
    /// topic.push(0.5, &[44, 1]);
    /// assert_eq!(topic.values("Alt"), Some(vec![300.0])); // 44 + 256
    /// assert_eq!(topic.values("Temp"), None);
    /// ```
    pub fn new(name: TopicName, fields: Vec<FieldLayout>) -> Self {
        let ends = fields.iter().map(|f| f.offset + f.kind.size());
        let width = ends.max().unwrap_or(0);
        Self {
            name,
            schema: String::new(),
            fields,
            times: Vec::new(),
            rows: Rows::new(width),
        }
    }

    /// Name of the kind of message that its rows are, whichever ROS or encoding they came by:
    /// `sensor_msgs/Imu`, `foxglove/LocationFix`, `vehicle_attitude`. Empty where the log tells none.
    pub fn kind(&self) -> String {
        schema::plain(&self.schema)
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether it has no rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// Appends a row.
    #[inline]
    pub fn push(&mut self, time: f64, row: &[u8]) {
        self.times.push(time);
        self.rows.push(row);
    }

    /// The field of that name.
    pub fn field(&self, name: &str) -> Option<&FieldLayout> {
        self.fields.iter().find(|f| f.name == name)
    }

    /// Value of a field in row `index`.
    pub fn value(&self, field: &FieldLayout, index: usize) -> Option<f64> {
        field.value(self.rows.get(index)?)
    }

    /// All values of the field of that name, one per row; `None` if there is no such field or it holds
    /// no numbers.
    pub fn values(&self, name: &str) -> Option<Vec<f64>> {
        let field = self.field(name).filter(|f| f.kind.is_number())?;
        Some(self.rows.iter().filter_map(|r| field.value(r)).collect())
    }

    /// All texts of the field of that name, one per row; `None` if there is no such field or it holds
    /// no letters.
    pub fn texts(&self, name: &str) -> Option<Vec<String>> {
        let field = self.field(name)?;
        self.rows.iter().map(|row| field.text(row)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::FieldKind;
    use super::*;

    #[test]
    fn values_of_a_field_stand_beside_their_times() {
        let fields = vec![
            FieldLayout::plain("Alt", FieldKind::U16, 0),
            FieldLayout::plain("Name", FieldKind::Text(2), 2),
        ];
        let mut topic = Topic::new(TopicName::single("BARO"), fields);
        topic.push(1.0, &[1, 0, b'a', 0]);
        topic.push(2.0, &[2, 1, b'b', b'c']);
        assert_eq!(topic.values("Alt"), Some(vec![1.0, 258.0]));
        let texts = topic.texts("Name").unwrap();
        assert_eq!(texts, ["a", "bc"]);
        assert_eq!(topic.values("Name"), None);
        assert_eq!(topic.values("Temp"), None);
        assert_eq!(topic.times, [1.0, 2.0]);
    }

    #[test]
    fn an_instance_is_part_of_the_name() {
        let second = TopicName {
            name: "GPS".to_owned(),
            instance: Some(1),
        };
        assert_eq!(second.to_string(), "GPS[1]");
        assert_eq!(TopicName::single("GPS").to_string(), "GPS");
    }
}
