//! The skills as bars, and the evidence for the skill under the cursor.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::{Line, Span};

use super::{StandingSubject, days};
use crate::app::room::standing::Pane;
use crate::campaign::{Lack, MASTERY_CHANCE, Mastery, Skill, SkillMove};
use crate::text;
use crate::text::Text;
use crate::ui::panel::Panel;
use crate::ui::theme::Role;
use crate::ui::widget::gauge::Gauge;
use crate::ui::widget::{aligned, below, clip, put, row_of, upper, width, wrap};

/// The width of a skill's bar, in columns.
const BAR: usize = 10;
/// The width of the cursor and the code before the name, and of the bar and the percentage after it, with their gaps.
const BEFORE_NAME: usize = 6;
const AFTER_NAME: usize = 1 + BAR + 8;
/// The gap between two texts, in columns.
const GAP: usize = 2;

/// Draws the list, and below it the changes of the skill under the cursor.
pub(super) fn draw(subject: &StandingSubject<'_>, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let inner = subject.pane(Pane::Skills, &look.say("standing-skills"), area, buffer);
    let cursor = subject.state.rooms().standing().skill();
    let columns = SkillColumns::new(subject, inner.width.into());
    for (row, skill) in Skill::ALL.iter().copied().enumerate() {
        let under_cursor = row == cursor;
        let row = row as u16;
        let line = line(subject, skill, under_cursor, &columns);
        put(buffer, inner, row, &line);
        if under_cursor && subject.has_cursor(Pane::Skills) {
            Panel::new(look, row_of(inner, row)).mark_cursor(buffer);
        }
    }
    let list = upper(inner, Skill::ALL.len() as u16);
    let has_keys = subject.has_cursor(Pane::Skills);
    Panel::new(look, list).mark_list(0, Skill::ALL.len(), has_keys, buffer);
    let skill = Skill::ALL.get(cursor).copied().unwrap_or(Skill::K1);
    draw_moves(
        subject,
        skill,
        below(inner, Skill::ALL.len() as u16),
        buffer,
    );
}

/// The widths of the texts, in columns.
struct SkillColumns {
    name: usize,
    mastery: usize,
}

impl SkillColumns {
    /// Columns as wide as their longest text; only the names are cut if there is not enough room.
    fn new(subject: &StandingSubject<'_>, room: usize) -> Self {
        let look = subject.look;
        let widest = |text: &dyn Fn(Skill) -> String| {
            let widths = Skill::ALL.iter().map(|skill| width(&text(*skill)));
            widths.max().unwrap_or(0)
        };
        let name = widest(&|skill| look.text(&skill.title()));
        let mastery = widest(&|skill| look.text(&mastery(subject, skill).title())) + GAP;
        let end = widest(&|skill| end(subject, skill));
        let left = room.saturating_sub(BEFORE_NAME + AFTER_NAME + mastery + end);
        Self {
            name: name.min(left),
            mastery,
        }
    }
}

fn mastery(subject: &StandingSubject<'_>, skill: Skill) -> Mastery {
    let known = subject.career.standing.skill(skill);
    known.mastery(subject.career.day)
}

fn is_next(subject: &StandingSubject<'_>, skill: Skill) -> bool {
    let next = subject.career.next();
    next.is_some_and(|(next, _)| next == skill)
}

/// The last column: whether the skill is to be trained next, or when a mastered one is due for review.
fn end(subject: &StandingSubject<'_>, skill: Skill) -> String {
    let look = subject.look;
    if is_next(subject, skill) {
        return look.say("standing-next");
    }
    let due = subject.career.standing.skill(skill).due_day();
    due.filter(|_| mastery(subject, skill) == Mastery::Mastered)
        .map(|due| text!("standing-review", when = days(due - subject.career.day)))
        .map(|text| look.text(&text))
        .unwrap_or_default()
}

fn line(
    subject: &StandingSubject<'_>,
    skill: Skill,
    under_cursor: bool,
    columns: &SkillColumns,
) -> Line<'static> {
    let look = subject.look;
    let mastery = mastery(subject, skill);
    let role = match mastery {
        Mastery::Unknown => Role::Muted,
        Mastery::Learning => Role::Text,
        Mastery::Mastered => Role::Ok,
        Mastery::Due => Role::Warning,
    };
    let known = subject.career.standing.skill(skill);
    let chance = Some(known.chance(subject.career.day)).filter(|_| mastery != Mastery::Unknown);
    let percent = chance.map_or_else(String::new, |chance| format!("{:.0} %", chance * 100.0));
    let mark = if under_cursor { '>' } else { ' ' };
    let head = format!(
        "{mark} {:<4}{} ",
        skill.code(),
        aligned(&look.text(&skill.title()), columns.name, false)
    );
    let bar = Gauge {
        share: chance.unwrap_or_default(),
        mark: Some(MASTERY_CHANCE),
        role,
    };
    let end_role = if is_next(subject, skill) {
        Role::Accent
    } else {
        Role::Muted
    };
    let mut spans = vec![Span::raw(head)];
    spans.extend(bar.spans(BAR, look));
    spans.extend([
        Span::raw(format!("{percent:>6}  ")),
        Span::styled(
            aligned(&look.text(&mastery.title()), columns.mastery, false),
            look.style(role),
        ),
        Span::styled(end(subject, skill), look.style(end_role)),
    ]);
    Line::from(spans)
}

/// Draws the changes of a skill, newest first.
fn draw_moves(subject: &StandingSubject<'_>, skill: Skill, area: Rect, buffer: &mut Buffer) {
    let look = subject.look;
    let title = text!("standing-why", skill = skill.title());
    let framed = Panel::new(look, below(area, 1)).titled(&look.text(&title), buffer);
    let inner = match lacks(subject, skill) {
        Some(lacks) => {
            let lines = wrap(&look.text(&lacks), usize::from(framed.width));
            let rows = lines.len() as u16;
            for (row, line) in (0..).zip(lines) {
                put(
                    buffer,
                    framed,
                    row,
                    &Line::styled(line, look.style(Role::Accent)),
                );
            }
            below(framed, rows)
        }
        None => framed,
    };
    let moves = subject.career.growth.moves(skill);
    if moves.is_empty() {
        let nothing = look.say("standing-why-nothing");
        let text = clip(&nothing, usize::from(inner.width));
        put(
            buffer,
            inner,
            0,
            &Line::styled(text, look.style(Role::Muted)),
        );
    }
    let rows = usize::from(inner.height);
    Panel::new(look, inner).mark_scroll(0, moves.len(), buffer);
    for (row, moved) in moves.iter().rev().take(rows).enumerate() {
        let line = moved_line(subject, moved, usize::from(inner.width));
        put(buffer, inner, row as u16, &line);
    }
}

/// The requirements for mastery that a skill does not meet yet, as text; `None` unless it is still
/// being learned.
fn lacks(subject: &StandingSubject<'_>, skill: Skill) -> Option<Text> {
    let (known, day) = (subject.career.standing.skill(skill), subject.career.day);
    let lacks = known.lacks(day).into_iter().map(Lack::text).collect();
    let needs = text!("standing-lacks", lacks = Text::joined(", ", lacks));
    (known.mastery(day) == Mastery::Learning).then_some(needs)
}

/// A change as a line, such as ` 48 -> 62 +14  Air sample: cells sampled 97 %, today`.
fn moved_line(subject: &StandingSubject<'_>, moved: &SkillMove, room: usize) -> Line<'static> {
    let look = subject.look;
    let percent = |share: f64| (share * 100.0).round() as i64;
    let (before, after) = (percent(moved.before), percent(moved.after));
    let change = after - before;
    let role = match change {
        1.. => Role::Ok,
        0 => Role::Muted,
        _ => Role::Danger,
    };
    let figures = format!("{before:>3} -> {after:>3} % ");
    let change = format!("{change:>+4} ");
    let offer = subject.career.course.offer(&moved.mission);
    let title = offer.map_or_else(
        || moved.mission.as_str().into(),
        |offer| offer.title.clone(),
    );
    let why = text!(
        "standing-moved",
        mission = title,
        what = moved.what.clone(),
        percent = percent(moved.outcome),
        when = days(moved.day - subject.career.day)
    );
    let left = room.saturating_sub(width(&figures) + width(&change) + 1);
    Line::from(vec![
        Span::styled(figures, look.style(Role::Muted)),
        Span::styled(change, look.style(role)),
        Span::raw(format!(" {}", clip(&look.text(&why), left))),
    ])
}
