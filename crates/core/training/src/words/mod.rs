//! Bag of words, by which the thesis tells the class of a window: descriptors, a vocabulary, a histogram, a support
//! vector machine (DeAngelo 2016, chapter 3).

mod classifier;
mod descriptors;
mod machine;
#[cfg(test)]
mod tests;
mod vocabulary;

pub use classifier::{WordClassifier, WordClassifierError, WordTraining, WordWindow};
pub use descriptors::{DESCRIPTOR, WordDescriptor, descriptors_of};
pub use machine::LinearMachine;
pub use vocabulary::Vocabulary;
