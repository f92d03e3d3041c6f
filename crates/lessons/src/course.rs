//! Courses: lessons in the order in which they are read.

use crate::lesson::Lesson;

/// Course of several lessons.
#[derive(Clone, Copy)]
pub struct Course {
    /// Name in addresses and of its text.
    pub name: &'static str,
    /// Title and what it is about; ten questions that its reader can answer afterwards, each with its lesson.
    pub text: &'static str,
    /// Its lessons.
    pub lessons: &'static [&'static Lesson],
}

/// All courses of the program, in their order.
#[derive(Clone, Copy)]
pub struct Courses(pub &'static [Course]);

impl Courses {
    /// Lesson of that name with its course and its place in it.
    pub fn find(&self, name: &str) -> Option<(&'static Course, usize, &'static Lesson)> {
        self.0.iter().find_map(|course| {
            let place = course.lessons.iter().position(|own| own.name == name)?;
            Some((course, place, course.lessons[place]))
        })
    }

    /// Lessons of all courses.
    pub fn lessons(&self) -> impl Iterator<Item = &'static Lesson> {
        self.0
            .iter()
            .flat_map(|course| course.lessons.iter().copied())
    }
}
