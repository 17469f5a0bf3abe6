//! The columns of the board.

/// The columns before the first column of the board: the cursor, the mark and a blank.
const MARKS: usize = 3;
/// The width from which all columns fit.
const WIDE: u16 = 110;
/// The least width of the last command.
const COMMAND: usize = 9;

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

    /// The columns that give way to those of an exam and of lessons, in this order. If there is not room for both, the
    /// exam has precedence: its time passes.
    const GIVE_WAY: [Self; 6] = [
        Self::Separation,
        Self::Failures,
        Self::Workload,
        Self::Alerts,
        Self::Command,
        Self::Lesson,
    ];

    /// The columns with their widths; the last one takes the rest of the row. Beside those of an exam and of lessons,
    /// others are shown as far as there is room.
    pub fn fitting(columns: u16, of_course: &[(Self, usize)]) -> Vec<(Self, usize)> {
        let known = if columns >= WIDE {
            Self::WIDE
        } else {
            Self::NARROW
        };
        let room = usize::from(columns).saturating_sub(MARKS);
        let mut fitting = known.to_vec();
        let at = fitting.len() - 1;
        fitting.splice(at..at, of_course.iter().copied());
        // One of them is always shown.
        let alone = of_course.first().filter(|_| of_course.len() == 1);
        let gives_way = Self::GIVE_WAY.iter();
        for column in gives_way.filter(|it| alone.is_none_or(|(alone, _)| alone != *it)) {
            if of_course.is_empty() || Self::least(&fitting) <= room {
                break;
            }
            fitting.retain(|(known, _)| known != column);
        }
        if let Some(((_, last), others)) = fitting.split_last_mut() {
            // Also less than it has alone, so that its end is not cut.
            let used: usize = others.iter().map(|(_, width)| width + 1).sum();
            *last = room.saturating_sub(used + 1);
        }
        fitting
    }

    /// The least width of columns, each with a blank.
    fn least(columns: &[(Self, usize)]) -> usize {
        let width = |&(column, width): &(Self, usize)| {
            let least = if column == Self::Command {
                COMMAND
            } else {
                width
            };
            least + 1
        };
        columns.iter().map(width).sum()
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

#[cfg(test)]
mod tests {
    use super::BoardColumn;

    fn shown(columns: u16, of_course: &[(BoardColumn, usize)]) -> Vec<BoardColumn> {
        let fitting = BoardColumn::fitting(columns, of_course).into_iter();
        fitting.map(|(column, _)| column).collect()
    }

    #[test]
    fn the_columns_of_an_exam_and_of_lessons_are_both_there_if_there_is_room() {
        let both = [BoardColumn::EXAM, BoardColumn::LESSON];
        for columns in [110, 118, 160] {
            let shown = shown(columns, &both);
            for column in [BoardColumn::Exam, BoardColumn::Lesson] {
                assert!(shown.contains(&column), "{columns}: {shown:?}");
            }
            assert!(shown.contains(&BoardColumn::Mission));
        }
        assert!(shown(118, &both).contains(&BoardColumn::Command));
        assert!(shown(160, &both).contains(&BoardColumn::Separation));
    }

    /// The command was once wider than what was left for it, so that its age was cut.
    #[test]
    fn the_columns_fit_into_the_row() {
        let both = [BoardColumn::EXAM, BoardColumn::LESSON];
        for of_course in [&[][..], &both[..1], &both[1..], &both] {
            for columns in 78..160 {
                let fitting = BoardColumn::fitting(columns, of_course);
                let used: usize = fitting.iter().map(|(_, width)| width + 1).sum();
                let row = usize::from(columns);
                assert_eq!(super::MARKS + used, row, "{fitting:?}");
            }
        }
    }

    #[test]
    fn the_exam_has_precedence_where_there_is_room_for_one_only() {
        let narrow = shown(78, &[BoardColumn::EXAM, BoardColumn::LESSON]);
        assert_eq!(narrow.last(), Some(&BoardColumn::Exam));
        assert!(!narrow.contains(&BoardColumn::Lesson));
        for alone in [BoardColumn::EXAM, BoardColumn::LESSON] {
            assert_eq!(shown(78, &[alone]).last(), Some(&alone.0));
            assert!(!shown(110, &[alone]).contains(&BoardColumn::Workload));
        }
        assert_eq!(shown(78, &[]).last(), Some(&BoardColumn::Command));
    }
}
