//! The columns of the board.

/// The columns before the first column of the board: the cursor, the mark and a blank.
const MARKS: usize = 3;
/// The width from which all columns fit.
const WIDE: u16 = 110;
/// The width from which all columns fit beside that of the lessons.
const WIDEST: u16 = 140;

/// A column of the board.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BoardColumn {
    Seat,
    State,
    Mission,
    Clock,
    Score,
    Objectives,
    Air,
    Alerts,
    Separation,
    Failures,
    Workload,
    Lesson,
    Exam,
    Command,
}

impl BoardColumn {
    const NARROW: &[(Self, usize)] = &[
        (Self::Seat, 10),
        (Self::State, 16),
        (Self::Mission, 11),
        (Self::Clock, 5),
        (Self::Score, 5),
        (Self::Objectives, 4),
        (Self::Air, 4),
        (Self::Command, 13),
    ];
    const WIDE: &[(Self, usize)] = &[
        (Self::Seat, 14),
        (Self::State, 17),
        (Self::Mission, 13),
        (Self::Clock, 5),
        (Self::Score, 5),
        (Self::Objectives, 4),
        (Self::Air, 5),
        (Self::Alerts, 8),
        (Self::Separation, 5),
        (Self::Failures, 5),
        (Self::Workload, 5),
        (Self::Command, 18),
    ];

    /// The column of lessons.
    pub const LESSON: (Self, usize) = (Self::Lesson, 16);

    /// The column of an exam.
    pub const EXAM: (Self, usize) = (Self::Exam, 16);

    /// The columns with their widths; the last one takes the rest of the row. While there are lessons or an exam,
    /// others give way to their column, unless all fit.
    pub fn fitting(columns: u16, of_course: Option<(Self, usize)>) -> Vec<(Self, usize)> {
        let known = if columns >= WIDE {
            Self::WIDE
        } else {
            Self::NARROW
        };
        let mut fitting = known.to_vec();
        if let Some(of_course) = of_course {
            fitting.retain(|(column, _)| columns >= WIDEST || !column.gives_way(columns));
            let last = fitting.len();
            let at = last - usize::from(columns >= WIDE);
            fitting.insert(at, of_course);
        }
        let used: usize = fitting.iter().map(|(_, width)| width + 1).sum();
        if let Some((_, last)) = fitting.last_mut() {
            *last += usize::from(columns).saturating_sub(used + MARKS);
        }
        fitting
    }

    /// Whether the column gives way to that of the lessons.
    fn gives_way(self, columns: u16) -> bool {
        match self {
            Self::Separation | Self::Failures | Self::Workload => columns >= WIDE,
            Self::Command => columns < WIDE,
            _ => false,
        }
    }

    pub fn title(self) -> &'static str {
        match self {
            Self::Seat => "class-column-seat",
            Self::State => "class-column-state",
            Self::Mission => "class-column-mission",
            Self::Clock => "class-column-clock",
            Self::Score => "class-column-score",
            Self::Objectives => "class-column-objectives",
            Self::Air => "class-column-air",
            Self::Alerts => "class-column-alerts",
            Self::Separation => "class-column-separation",
            Self::Failures => "class-column-failures",
            Self::Workload => "class-column-workload",
            Self::Lesson => "class-column-lesson",
            Self::Exam => "class-column-exam",
            Self::Command => "class-column-command",
        }
    }

    /// Whether the column has figures.
    pub fn is_right(self) -> bool {
        !matches!(
            self,
            Self::Seat | Self::State | Self::Mission | Self::Lesson | Self::Exam | Self::Command
        )
    }
}
