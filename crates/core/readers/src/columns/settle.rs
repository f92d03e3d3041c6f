//! Roles given to columns and taken from them again.

use super::{Alternative, ColumnRole, MappedColumn};

/// A column that means nothing, for that reason.
pub(super) fn unused(name: &str, reason: &str) -> MappedColumn {
    MappedColumn {
        name: name.to_owned(),
        role: ColumnRole::Nothing,
        unit: String::new(),
        scale: 1.0,
        offset: 0.0,
        confidence: 0.0,
        reason: reason.to_owned(),
        alternatives: Vec::new(),
    }
}

/// Leaves each role to the column that most likely is it, and takes away those that are of no use alone.
pub(super) fn settle(columns: &mut [MappedColumn]) {
    use ColumnRole::{Channel, Course, Latitude, Longitude, SpeedOverGround};
    use pilotage_flight::ChannelName::{GpsEast, GpsNorth};
    for index in 0..columns.len() {
        let (role, confidence) = (columns[index].role, columns[index].confidence);
        let better = columns.iter().enumerate().find(|(other, column)| {
            let wins =
                column.confidence > confidence || column.confidence == confidence && *other < index;
            *other != index && column.role == role && wins
        });
        if let Some((_, better)) = better.filter(|_| !role.may_be_several()) {
            let reason = format!("{} is more likely the {}", better.name, role.label());
            give_up(&mut columns[index], reason);
        }
    }
    for (one, other) in [
        (Latitude, Longitude),
        (SpeedOverGround, Course),
        (ColumnRole::WindSpeed, ColumnRole::WindFrom),
        (Channel(GpsNorth), Channel(GpsEast)),
    ] {
        for (one, other) in [(one, other), (other, one)] {
            let has_other = columns.iter().any(|column| column.role == other);
            let alone = columns
                .iter_mut()
                .find(|column| column.role == one)
                .filter(|_| !has_other);
            if let Some(column) = alone {
                let reason = format!("{} is of no use without {}", one.label(), other.label());
                give_up(column, reason);
            }
        }
    }
    let is_of_quaternion = |role| {
        matches!(
            role,
            ColumnRole::Quaternion(_) | ColumnRole::RosQuaternion(_)
        )
    };
    if columns
        .iter()
        .any(|column| column.role == Channel(pilotage_flight::ChannelName::Heading))
    {
        let quaternion = columns
            .iter_mut()
            .filter(|column| is_of_quaternion(column.role));
        for column in quaternion {
            give_up(column, "heading, roll and pitch say the same".to_owned());
        }
    }
    // Places on the globe say where metres are counted from.
    if columns
        .iter()
        .any(|column| matches!(column.role, Latitude | ColumnRole::Place))
    {
        for column in columns.iter_mut() {
            if matches!(column.role, Channel(GpsNorth | GpsEast)) {
                give_up(column, "latitude and longitude say more".to_owned());
            }
        }
    }
}

/// Takes its role from a column, and keeps it as the first of what else it may be.
pub(super) fn give_up(column: &mut MappedColumn, reason: String) {
    column.alternatives.insert(
        0,
        Alternative {
            role: column.role,
            unit: std::mem::take(&mut column.unit),
            confidence: column.confidence,
        },
    );
    column.role = ColumnRole::Nothing;
    column.scale = 1.0;
    column.confidence = 0.0;
    column.reason = reason;
}
