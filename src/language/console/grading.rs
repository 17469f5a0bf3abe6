//! Lines about the grades of a flight.

/// A command about grades, at the desk.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum GradingLine {
    /// Show a flight of a trainee with its grades: of the one with this name, otherwise of the one under the cursor.
    Open {
        trainee: Option<String>,
        /// The name of a rubric; the last one without it.
        rubric: Option<String>,
    },
    /// Grade the element under the cursor.
    Rate(Rating),
    /// Set the remark of the element under the cursor.
    Remark(String),
    /// Refer to the bookmark with this number, from 1, at the element under the cursor, or no longer refer to it.
    Cite(usize),
}

/// A change of an element's mark.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rating {
    /// A mark, 1 to 5.
    Mark(u8),
    NotObserved,
    /// No grade, as at first.
    Clear,
}

impl Rating {
    /// The ratings as they are typed.
    pub const NAMES: &'static [&'static str] = &["1", "2", "3", "4", "5", "unobserved", "clear"];

    /// The rating with one of the names.
    pub fn by_name(name: &str) -> Option<Self> {
        match name {
            "unobserved" => Some(Self::NotObserved),
            "clear" => Some(Self::Clear),
            digit => {
                let mark = digit.parse().ok();
                mark.filter(|it| (1..=5).contains(it)).map(Self::Mark)
            }
        }
    }
}
