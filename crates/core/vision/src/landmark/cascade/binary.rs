//! A compact form of a cascade, a tenth to a third of its XML.
//!
//! `PCAS`, a byte for the version (1), a byte for the kind (0 Haar, 1 LBP, 2 HOG), then: width, height;
//! number of features, and each; number of stages, and of each the threshold as it acts, the number of
//! trees, and of each the number of nodes, the nodes, the leaves. At the end four bytes of FNV-1a over
//! all before.
//!
//! Whole numbers have seven bits a byte, the lowest first, the highest bit set where more follow; what
//! may be negative is folded (0, -1, 1, -2, …). Other numbers and words of LBP codes have four bytes,
//! the lowest first. A Haar feature is the number of its rectangles, plus four if they are turned, and
//! of each left, top, width, height, weight; an LBP feature is its first block; a HOG feature its first
//! cell and component. A node is its feature, left, right, and its threshold or eight words of codes.

use super::CascadeError;
use super::check::{NO_AREA, empty};
use super::model::{Area, Cascade, CascadeFeature, CascadeKind, HaarFeature, TreeNode};
use super::write::leaves;
use pilotage_base::varint::{VarintError, put_varint, take_varint, unzigzag, zigzag};

/// First bytes of the format.
const MAGIC: [u8; 4] = *b"PCAS";
/// Version of the format.
const VERSION: u8 = 1;
/// Bytes of the check at the end.
const CHECK: usize = 4;

/// Most bytes of a whole number.
const LONGEST_NUMBER: usize = 5;
const ENDS_EARLY: &str = "it ends too early";

/// FNV-1a, 32 bits (Fowler, Noll and Vo).
fn check_sum(bytes: &[u8]) -> u32 {
    let step = |hash: u32, byte: &u8| (hash ^ u32::from(*byte)).wrapping_mul(0x0100_0193);
    bytes.iter().fold(0x811c_9dc5, step)
}

fn put_area(out: &mut Vec<u8>, area: &Area) {
    for side in area {
        put_varint(out, u64::from(side.unsigned_abs()));
    }
}

fn put_feature(out: &mut Vec<u8>, feature: &CascadeFeature) {
    match feature {
        CascadeFeature::Haar(haar) => {
            let areas = haar.areas.iter().filter(|(_, weight)| *weight != 0.0);
            put_varint(
                out,
                areas.clone().count() as u64 + 4 * u64::from(haar.tilted),
            );
            for (area, weight) in areas {
                put_area(out, area);
                out.extend(weight.to_le_bytes());
            }
        }
        CascadeFeature::Lbp(area) => put_area(out, area),
        CascadeFeature::Hog { cell, component } => {
            put_area(out, cell);
            out.push(*component);
        }
    }
}

impl Cascade {
    /// The compact form; reading it gives an equal cascade.
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut out = MAGIC.to_vec();
        out.push(VERSION);
        out.push(match self.kind() {
            CascadeKind::Haar => 0,
            CascadeKind::Lbp => 1,
            CascadeKind::Hog => 2,
        });
        for count in [self.width, self.height, self.features.len()] {
            put_varint(&mut out, count as u64);
        }
        for feature in &self.features {
            put_feature(&mut out, feature);
        }
        put_varint(&mut out, self.stages.len() as u64);
        for stage in &self.stages {
            out.extend(stage.threshold.to_le_bytes());
            put_varint(&mut out, stage.trees.len() as u64);
            for tree in &self.trees[stage.trees.clone()] {
                put_varint(&mut out, tree.nodes.len() as u64);
                for index in tree.nodes.clone() {
                    let node = &self.nodes[index];
                    put_varint(&mut out, u64::from(node.feature));
                    put_varint(&mut out, zigzag(node.left.into()));
                    put_varint(&mut out, zigzag(node.right.into()));
                    match self.subsets.get(index) {
                        Some(words) => words.iter().for_each(|w| out.extend(w.to_le_bytes())),
                        None => out.extend(node.threshold.to_le_bytes()),
                    }
                }
                for leaf in &self.leaves[leaves(tree)] {
                    out.extend(leaf.to_le_bytes());
                }
            }
        }
        let sum = check_sum(&out);
        out.extend(sum.to_le_bytes());
        out
    }

    /// Reads the compact form.
    ///
    /// # Errors
    /// Says at which byte what is wrong.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CascadeError> {
        let mut source = ByteCursor { bytes, at: 0 };
        match source.read() {
            Err(cause) => Err(CascadeError::Bytes {
                offset: source.at,
                cause,
            }),
            Ok(cascade) => Ok(cascade),
        }
    }
}

/// Bytes that are read one after the other.
struct ByteCursor<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl ByteCursor<'_> {
    fn take<const N: usize>(&mut self) -> Result<[u8; N], String> {
        match self.bytes.get(self.at..).and_then(<[u8]>::first_chunk) {
            Some(taken) => {
                self.at += N;
                Ok(*taken)
            }
            None => Err(ENDS_EARLY.to_owned()),
        }
    }

    fn whole(&mut self) -> Result<u32, String> {
        let mut rest = self.bytes.get(self.at..).unwrap_or_default();
        let number = take_varint(&mut rest, LONGEST_NUMBER);
        self.at = self.bytes.len() - rest.len();
        let value = number.map_err(|cause| match cause {
            VarintError::EndsEarly => ENDS_EARLY.to_owned(),
            VarintError::TooLong => "a number of over five bytes".to_owned(),
        })?;
        u32::try_from(value).map_err(|_| format!("a number of {value}"))
    }

    fn folded(&mut self) -> Result<i32, String> {
        Ok(unzigzag(self.whole()?.into()) as i32)
    }

    fn real(&mut self) -> Result<f32, String> {
        Ok(f32::from_le_bytes(self.take()?))
    }

    fn area(&mut self) -> Result<Area, String> {
        let mut area = [0; 4];
        for side in &mut area {
            let value = self.whole()?;
            *side = i32::try_from(value).map_err(|_| format!("a rectangle with {value}"))?;
        }
        Ok(area)
    }

    fn feature(&mut self, kind: CascadeKind) -> Result<CascadeFeature, String> {
        Ok(match kind {
            CascadeKind::Haar => {
                let header = self.whole()?;
                let (count, tilted) = ((header % 4) as usize, header / 4 == 1);
                if header >= 8 {
                    return Err(format!("a feature of the form {header}"));
                }
                let mut areas = [NO_AREA; 3];
                for area in &mut areas[..count] {
                    *area = (self.area()?, self.real()?);
                }
                CascadeFeature::Haar(HaarFeature { areas, tilted })
            }
            CascadeKind::Lbp => CascadeFeature::Lbp(self.area()?),
            CascadeKind::Hog => CascadeFeature::Hog {
                cell: self.area()?,
                component: self.take::<1>()?[0],
            },
        })
    }

    fn tree(&mut self, kind: CascadeKind, cascade: &mut Cascade) -> Result<(), String> {
        let (mut nodes, mut leaves) = (Vec::new(), Vec::new());
        for _ in 0..self.whole()? {
            let (feature, left, right) = (self.whole()?, self.folded()?, self.folded()?);
            let mut threshold = 0.0;
            if kind == CascadeKind::Lbp {
                let mut words = [0; 8];
                for word in &mut words {
                    *word = u32::from_le_bytes(self.take()?);
                }
                cascade.subsets.push(words);
            } else {
                threshold = self.real()?;
            }
            nodes.push(TreeNode {
                feature,
                left,
                right,
                threshold,
            });
        }
        for _ in 0..=nodes.len() {
            leaves.push(self.real()?);
        }
        cascade.grow(&nodes, &leaves)
    }

    fn read(&mut self) -> Result<Cascade, String> {
        if self.take()? != MAGIC {
            return Err("it does not begin as a cascade does".to_owned());
        }
        let [version] = self.take()?;
        if version != VERSION {
            return Err(format!(
                "version {version}, and only {VERSION} is known here"
            ));
        }
        let body = self.bytes.len().saturating_sub(CHECK);
        let (content, sum) = self.bytes.split_at(body);
        if check_sum(content).to_le_bytes() != sum {
            return Err("its check sum is another: it was damaged".to_owned());
        }
        self.bytes = content;
        let kind = match self.take()? {
            [0] => CascadeKind::Haar,
            [1] => CascadeKind::Lbp,
            [2] => CascadeKind::Hog,
            [other] => return Err(format!("features of the kind {other} are not known")),
        };
        let mut cascade = empty(i64::from(self.whole()?), i64::from(self.whole()?))?;
        for _ in 0..self.whole()? {
            cascade.add_feature(self.feature(kind)?)?;
        }
        for _ in 0..self.whole()? {
            let (first_tree, threshold) = (cascade.trees.len(), self.real()?);
            for _ in 0..self.whole()? {
                self.tree(kind, &mut cascade)?;
            }
            cascade.end_stage(first_tree, threshold)?;
        }
        if self.at < content.len() {
            return Err(format!("{} bytes too many", content.len() - self.at));
        }
        cascade.check()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_come_back() {
        for value in [0, 1, -1, 63, -64, 64, 70_000, i32::MAX, i32::MIN] {
            let mut bytes = Vec::new();
            put_varint(&mut bytes, zigzag(value.into()));
            let mut source = ByteCursor {
                bytes: &bytes,
                at: 0,
            };
            assert_eq!(source.folded(), Ok(value));
            assert_eq!(source.at, bytes.len());
        }
    }

    #[test]
    fn what_is_damaged_is_said_to_be() {
        let said = |bytes: &[u8]| Cascade::from_bytes(bytes).expect_err("refused").to_string();
        assert!(said(b"").contains("too early"));
        assert!(said(b"RIFF....").contains("does not begin"));
        assert!(said(b"PCAS\x02").contains("version 2"));
        assert!(said(b"PCAS\x01\x00\x18\x18").contains("damaged"));
    }
}
