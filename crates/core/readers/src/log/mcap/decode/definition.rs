//! Definitions of ROS messages: lines of a type and a name, and those of the types within.

use std::collections::HashMap;

use crate::log::FieldKind;

/// Types within types within types…
const DEEPEST: usize = 24;
/// Most members of all types of a definition together.
const MOST_MEMBERS: usize = 1 << 14;

/// Version of ROS.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Version {
    First,
    Second,
}

/// Type of a member.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum MemberType {
    Number(FieldKind),
    Text,
    /// Another type, by its number.
    Type(usize),
}

/// Number of elements of a member.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Count {
    One,
    Always(usize),
    /// As many as a number before them says.
    Counted,
}

/// A member of a type.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Member {
    /// Name; without one, it says nothing.
    pub name: String,
    pub element: MemberType,
    pub count: Count,
    /// Fewest bytes that one element takes.
    pub shortest: usize,
}

impl Member {
    /// Fewest bytes that all of it takes.
    fn least(&self) -> usize {
        match self.count {
            Count::One => self.shortest,
            Count::Always(count) => self.shortest.saturating_mul(count),
            Count::Counted => 4,
        }
    }
}

/// Member that ROS 2 writes for a type without members, as its interface language allows none such.
const FILLER: Member = Member {
    name: String::new(),
    element: MemberType::Number(FieldKind::U8),
    count: Count::One,
    shortest: 1,
};

/// The types of a message, each after those that it is made of; the last is the message itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Types {
    pub types: Vec<Vec<Member>>,
    /// Fewest bytes that a value of each type takes.
    pub least: Vec<usize>,
}

impl Types {
    /// Reads the definition of the message `name` with those of the types within. The error says in words what
    /// is wrong with it.
    pub fn parse(name: &str, text: &[u8], version: Version) -> Result<Self, String> {
        let text = str::from_utf8(text).map_err(|_| "its definition is no text".to_owned())?;
        let mut reading = DefinitionReading {
            texts: sections(name, text),
            version,
            types: Self::default(),
            numbers: HashMap::new(),
            members: 0,
        };
        reading.number(name, "", 0)?;
        Ok(reading.types)
    }
}

/// The text of each definition by its name without `msg/`.
fn sections<'a>(name: &str, text: &'a str) -> HashMap<String, &'a str> {
    let mut sections = HashMap::new();
    let mut name = plain(name);
    let mut start = 0;
    let mut place = 0;
    for line in text.split_inclusive('\n') {
        let end = place;
        place += line.len();
        let words = line.trim();
        if words.len() >= 3 && words.bytes().all(|b| b == b'=') {
            sections
                .entry(std::mem::take(&mut name))
                .or_insert(&text[start..end]);
            start = place;
        } else if let Some(next) = words.strip_prefix("MSG:") {
            name = plain(next.trim());
            start = place;
        }
    }
    sections.entry(name).or_insert(&text[start..]);
    sections
}

/// `std_msgs/Header` for `std_msgs/msg/Header`.
fn plain(name: &str) -> String {
    name.replacen("/msg/", "/", 1)
}

struct DefinitionReading<'a> {
    texts: HashMap<String, &'a str>,
    version: Version,
    types: Types,
    numbers: HashMap<String, Option<usize>>,
    members: usize,
}

impl DefinitionReading<'_> {
    /// Number of the type `name` as it is called in `package`.
    fn number(&mut self, name: &str, package: &str, depth: usize) -> Result<usize, String> {
        let mut name = plain(name);
        let is_first = self.version == Version::First;
        if name == "Header" {
            "std_msgs/Header".clone_into(&mut name);
        } else if is_first && matches!(name.as_str(), "time" | "duration") {
            // They are in no package.
        } else if !name.contains('/') && !package.is_empty() {
            name = format!("{package}/{name}");
        }
        match self.numbers.get(&name) {
            Some(Some(number)) => return Ok(*number),
            Some(None) => return Err(format!("{name} is made of itself")),
            None if depth > DEEPEST => return Err("its definition is too deep".to_owned()),
            None => {}
        }
        self.numbers.insert(name.clone(), None);
        let text = match self.texts.get(&name) {
            Some(text) => *text,
            None => {
                built_in(&name, self.version).ok_or_else(|| format!("{name} is not defined"))?
            }
        };
        let package = name.rsplit_once('/').map_or("", |(package, _)| package);
        let mut members = Vec::new();
        for line in text.lines() {
            members.extend(self.member(line, package, depth)?);
        }
        if members.is_empty() && self.version == Version::Second {
            members.push(FILLER);
        }
        self.members += members.len();
        if self.members > MOST_MEMBERS {
            return Err("its definition is too long".to_owned());
        }
        let number = self.types.types.len();
        let least = members.iter().map(Member::least);
        self.types.least.push(least.fold(0, usize::saturating_add));
        self.types.types.push(members);
        self.numbers.insert(name, Some(number));
        Ok(number)
    }

    /// The member that a line defines; `None` for constants, remarks, and what takes no bytes at all.
    fn member(
        &mut self,
        line: &str,
        package: &str,
        depth: usize,
    ) -> Result<Option<Member>, String> {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_whitespace();
        let (Some(kind), Some(name)) = (words.next(), words.next()) else {
            return Ok(None);
        };
        let is_constant =
            name.contains('=') || words.next().is_some_and(|word| word.starts_with('='));
        if is_constant {
            return Ok(None);
        }
        let wrong = || {
            format!(
                "\"{}\" is no type",
                kind.chars().take(40).collect::<String>()
            )
        };
        let (kind, count) = match kind.split_once('[') {
            None => (kind, Count::One),
            Some((kind, count)) => {
                let count = count.strip_suffix(']').ok_or_else(wrong)?;
                let count = if count.is_empty() || count.starts_with("<=") {
                    Count::Counted
                } else {
                    Count::Always(count.parse().map_err(|_| wrong())?)
                };
                (kind, count)
            }
        };
        // A bound of letters: string<=10.
        let kind = kind.split("<=").next().unwrap_or_default();
        let element = match element(kind, self.version) {
            Some(element) => element,
            None if kind == "wstring" => {
                return Err("wide letters are written in several ways".to_owned());
            }
            None => MemberType::Type(self.number(kind, package, depth + 1)?),
        };
        let shortest = match element {
            MemberType::Number(kind) => kind.size(),
            MemberType::Text => 4,
            MemberType::Type(number) => self.types.least[number],
        };
        let is_nothing = shortest == 0 && count != Count::Counted || count == Count::Always(0);
        Ok((!is_nothing).then(|| Member {
            name: name.to_owned(),
            element,
            count,
            shortest,
        }))
    }
}

/// Element of a built-in type; `None` for other types.
fn element(kind: &str, version: Version) -> Option<MemberType> {
    Some(MemberType::Number(match kind {
        "bool" => FieldKind::Bool,
        "int8" => FieldKind::I8,
        "byte" if version == Version::First => FieldKind::I8,
        "uint8" | "char" | "byte" => FieldKind::U8,
        "int16" => FieldKind::I16,
        "uint16" => FieldKind::U16,
        "int32" => FieldKind::I32,
        "uint32" => FieldKind::U32,
        "int64" => FieldKind::I64,
        "uint64" => FieldKind::U64,
        "float32" => FieldKind::F32,
        "float64" => FieldKind::F64,
        "string" => return Some(MemberType::Text),
        _ => return None,
    }))
}

/// Definitions that are often left out.
fn built_in(name: &str, version: Version) -> Option<&'static str> {
    Some(match (name, version) {
        ("time", Version::First) => "uint32 secs\nuint32 nsecs\n",
        ("duration", Version::First) => "int32 secs\nint32 nsecs\n",
        ("std_msgs/Header", Version::First) => "uint32 seq\ntime stamp\nstring frame_id\n",
        ("std_msgs/Header", Version::Second) => "builtin_interfaces/Time stamp\nstring frame_id\n",
        ("builtin_interfaces/Time" | "builtin_interfaces/Duration", Version::Second) => {
            "int32 sec\nuint32 nanosec\n"
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const IMU: &str = "\
# What an inertial unit measured
std_msgs/Header header
geometry_msgs/Vector3 rate   # rad/s
float64[9] covariance
string<=10[<=3] names [\"a\"]
int32 MOST=7
uint8 LEAST = 3
uint8 state 5
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
===
MSG: geometry_msgs/msg/Vector3
float64 x
float64 y
float64 z
";

    #[test]
    fn a_definition_is_read_with_the_types_within() {
        let types = Types::parse("my_msgs/msg/Imu", IMU.as_bytes(), Version::Second);
        let types = types.expect("it is a definition").types;
        let names: Vec<Vec<_>> = types
            .iter()
            .map(|members| members.iter().map(|m| m.name.as_str()).collect())
            .collect();
        let expected: [&[&str]; 4] = [
            &["sec", "nanosec"],
            &["stamp", "frame_id"],
            &["x", "y", "z"],
            &["header", "rate", "covariance", "names", "state"],
        ];
        assert_eq!(names, expected);
        assert_eq!(types[3][2].count, Count::Always(9));
        assert_eq!(
            (types[3][3].count, types[3][3].element),
            (Count::Counted, MemberType::Text)
        );
    }

    #[test]
    fn what_cannot_be_read_is_told_in_words() {
        let wrong = |text: &str| {
            Types::parse("a/B", text.as_bytes(), Version::First).expect_err("it is wrong")
        };
        assert!(wrong("Other o\n").contains("a/Other is not defined"));
        assert!(wrong("B b\n").contains("made of itself"));
        assert!(wrong("int32[x] b\n").contains("no type"));
        assert!(wrong("wstring b\n").contains("wide"));
    }

    #[test]
    fn empty_types_take_no_part_however_many_there_are() {
        let text = "Nothing[1000000000] n\nuint8 a\n===\nMSG: a/Nothing\n";
        let types = Types::parse("a/B", text.as_bytes(), Version::First).expect("it is fine");
        assert_eq!(types.types[1].len(), 1);
        let text = "B[100000] b\n===\nMSG: a/B\nC[100000] c\n===\nMSG: a/C\nfloat64[100000] d\n";
        let types = Types::parse("a/A", text.as_bytes(), Version::First).expect("it is fine");
        assert!(types.least[2] > 1 << 40 || types.least[2] == usize::MAX);
    }
}
