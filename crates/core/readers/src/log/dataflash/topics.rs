//! Topics that the rows of a kind of message go to.

use std::collections::BTreeMap;

use super::super::{FieldKind, FieldLayout, Log, Rows, TopicName};
use super::clock::Stamp;
use super::format::{MessageField, MessageFormat};
use super::units::{INSTANCE, Labels, UnitTables};

/// Most topics of a log: what is damaged or made up must not fill the memory with names.
const TOPICS: usize = 4096;
/// Most instances of a kind of message.
const INSTANCES: usize = 256;
/// Most layouts under one name.
const LAYOUTS: usize = 64;

/// Kind of message that states the units of each topic: the last that began to put rows there.
#[derive(Clone, Debug, Default)]
pub struct Owners {
    /// Number of the kind, by place of the topic.
    numbers: Vec<Option<u8>>,
    /// Whether topics may have to learn other units.
    pub is_changed: bool,
}

impl Owners {
    fn set(&mut self, place: usize, number: u8) {
        if self.numbers.len() <= place {
            self.numbers.resize(place + 1, None);
        }
        self.numbers[place] = Some(number);
        self.is_changed = true;
    }

    fn is(&self, place: usize, number: u8) -> bool {
        self.numbers.get(place) == Some(&Some(number))
    }
}

/// A kind of message, and where its rows go.
#[derive(Clone, Debug)]
pub struct MessageKind {
    /// As it was announced.
    pub format: MessageFormat,
    /// Field of its time.
    pub stamp: Option<Stamp>,
    /// Letters of its units.
    labels: Labels,
    /// The field by which instances are told apart, by its place among the fields.
    instance: Option<usize>,
    /// Fields as topics get them.
    fields: Vec<FieldLayout>,
    /// Topic of the rows that no instance is told of.
    whole: Option<usize>,
    /// Topics by what the instance field holds.
    parts: BTreeMap<Vec<u8>, usize>,
}

impl MessageKind {
    /// A kind without rows.
    pub fn new(format: MessageFormat, labels: Labels, units: &UnitTables) -> Self {
        let mut kind = Self {
            stamp: Stamp::of(&format),
            format,
            labels: Labels::default(),
            instance: None,
            fields: Vec::new(),
            whole: None,
            parts: BTreeMap::new(),
        };
        kind.set_labels(labels, units);
        kind
    }

    /// Letters of its units.
    pub fn labels(&self) -> &Labels {
        &self.labels
    }

    /// Learns the letters of its units; whether it has other instances now.
    pub fn set_labels(&mut self, labels: Labels, units: &UnitTables) -> bool {
        self.labels = labels;
        self.set_fields(units);
        let (columns, _) = self.format.fields();
        let marked = match self.labels.units.as_slice() {
            [] => usual_instance(&self.format.name, &columns),
            units => units.iter().position(|u| *u == INSTANCE),
        };
        let name = marked.and_then(|i| columns.get(i)).map(|c| &c.name);
        let instance = name.and_then(|name| self.fields.iter().position(|f| f.name == *name));
        let is_other = instance != self.instance;
        self.instance = instance;
        is_other
    }

    fn set_fields(&mut self, units: &UnitTables) {
        self.fields.clear();
        let (columns, used) = self.format.fields();
        for (i, column) in columns.iter().enumerate() {
            let (unit, scale) = units.of(&self.labels, i, &column.letter);
            let kind = column.letter.kind;
            for element in 0..column.letter.count {
                let name = match column.letter.count {
                    1 => column.name.clone(),
                    _ => format!("{}[{element}]", column.name),
                };
                self.fields.push(FieldLayout {
                    unit: unit.clone(),
                    scale,
                    ..FieldLayout::plain(name, kind, column.offset + element * kind.size())
                });
            }
        }
        if self.format.length > used {
            let kind = FieldKind::Bytes((self.format.length - used) as u16);
            self.fields.push(FieldLayout::plain("rest", kind, used));
        }
    }

    /// Brings units and scales of its topics up to what the tables say now.
    pub fn update(&mut self, units: &UnitTables, owners: &Owners, log: &mut Log) {
        self.set_fields(units);
        let number = self.format.number;
        for place in self.places().filter(|place| owners.is(*place, number)) {
            log.topics[place].fields.clone_from(&self.fields);
        }
    }

    /// Place of the topic that a row goes to; `None` if there are too many topics.
    #[inline]
    pub fn place(&mut self, body: &[u8], owners: &mut Owners, log: &mut Log) -> Option<usize> {
        let Some(instance) = self.instance else {
            return match self.whole {
                Some(place) => Some(place),
                None => self.whole_topic(owners, log),
            };
        };
        let key = self.fields.get(instance)?.bytes(body).unwrap_or_default();
        match self.parts.get(key) {
            Some(place) => Some(*place),
            None => self.part_topic(instance, body, owners, log),
        }
    }

    fn whole_topic(&mut self, owners: &mut Owners, log: &mut Log) -> Option<usize> {
        let name = TopicName::single(&self.format.name);
        let place = topic_for(&name, &self.fields, log)?;
        owners.set(place, self.format.number);
        self.whole = Some(place);
        self.whole
    }

    fn part_topic(
        &mut self,
        instance: usize,
        body: &[u8],
        owners: &mut Owners,
        log: &mut Log,
    ) -> Option<usize> {
        if self.parts.len() >= INSTANCES {
            if self.whole.is_none() {
                let name = &self.format.name;
                log.report.remark(format!(
                    "{name}: too many instances; the rest stays together"
                ));
                self.whole_topic(owners, log);
            }
            return self.whole;
        }
        let field = &self.fields[instance];
        let name = instance_name(&self.format.name, field, body);
        let place = topic_for(&name, &self.fields, log)?;
        owners.set(place, self.format.number);
        let key = field.bytes(body).unwrap_or_default();
        self.parts.insert(key.to_vec(), place);
        Some(place)
    }

    /// Sorts rows that came before their instances were told of.
    pub fn sort(&mut self, owners: &mut Owners, log: &mut Log) {
        self.parts.clear();
        let Some(place) = self.whole.take() else {
            return;
        };
        let Some(instance) = self.instance else {
            return;
        };
        let topic = &mut log.topics[place];
        let times = std::mem::take(&mut topic.times);
        let width = topic.rows.width();
        let rows = std::mem::replace(&mut topic.rows, Rows::new(width));
        if let Some(first) = rows.get(0) {
            let name = instance_name(&self.format.name, &self.fields[instance], first);
            log.rename(place, &name);
        }
        for (time, row) in times.into_iter().zip(rows.iter()) {
            if let Some(place) = self.place(row, owners, log) {
                log.topics[place].push(time, row);
            }
        }
    }

    /// Forgets where its rows went, for another kind sorted them.
    pub fn forget(&mut self, place: usize) {
        if self.whole == Some(place) {
            self.whole = None;
        }
        self.parts.retain(|_, part| *part != place);
    }

    /// Topic of the rows that no instance is told of.
    pub fn whole(&self) -> Option<usize> {
        self.whole
    }

    /// Places of all its topics.
    pub fn places(&self) -> impl Iterator<Item = usize> {
        self.parts.values().copied().chain(self.whole)
    }
}

/// The field by which instances are told apart in logs that state no units: the number behind the time that is called `I`, or
/// `C` in messages of estimators.
fn usual_instance(message: &str, columns: &[MessageField]) -> Option<usize> {
    let second = columns.get(1)?;
    let is_usual = second.name == "I" || second.name == "C" && message.starts_with(['X', 'N']);
    (is_usual && second.letter.kind == FieldKind::U8).then_some(1)
}

/// Name of the topic of an instance. What is no whole number of 32 bits stands in the name itself.
fn instance_name(name: &str, field: &FieldLayout, body: &[u8]) -> TopicName {
    let bytes = field.bytes(body).unwrap_or_default();
    let number = field
        .kind
        .integer(bytes)
        .and_then(|n| u32::try_from(n).ok());
    if number.is_some() {
        return TopicName {
            name: name.to_owned(),
            instance: number,
        };
    }
    let text = field
        .text(body)
        .or_else(|| field.kind.integer(bytes).map(|n| n.to_string()));
    let text = text
        .or_else(|| field.value(body).map(|v| v.to_string()))
        .unwrap_or_default();
    TopicName::single(format!("{name}[{text}]"))
}

fn is_same_layout(a: &[FieldLayout], b: &[FieldLayout]) -> bool {
    let same = |(a, b): (&FieldLayout, &FieldLayout)| {
        a.name == b.name && a.kind == b.kind && a.offset == b.offset
    };
    a.len() == b.len() && a.iter().zip(b).all(same)
}

/// The topic of that name and those fields. Where another layout has the name already, as in logs that were
/// joined, the later one is called `NAME~2`.
fn topic_for(name: &TopicName, fields: &[FieldLayout], log: &mut Log) -> Option<usize> {
    for layout in 1..=LAYOUTS {
        let name = match layout {
            1 => name.clone(),
            _ => TopicName {
                name: format!("{}~{layout}", name.name),
                instance: name.instance,
            },
        };
        match log.place(&name) {
            Some(place) if is_same_layout(&log.topics[place].fields, fields) => return Some(place),
            Some(_) => {}
            None if log.topics.len() < TOPICS => {
                if layout > 1 {
                    log.report
                        .remark(format!("{name}: its fields change within the file"));
                }
                return Some(log.topic_or_new(&name, || fields.to_vec()));
            }
            None => break,
        }
    }
    None
}
