//! The mission's page, line by line.

use std::time::Duration;

use unicode_width::UnicodeWidthStr as _;

use super::shown;
use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::{Meaning, Place};
use crate::app::room::Room;
use crate::mission::{Listing, ObjectiveState};
use crate::text;
use crate::text::{Locale, Text, reflow, wrap};

mod career;
mod fits;
mod launch;
mod points;
mod rewards;
mod tries;

/// The least width for two columns.
const TWO_COLUMNS: u16 = 110;
/// The greatest width of a line.
const WIDEST: usize = 88;
/// The most columns for the state of an objective; `POINTS` is the width of its points.
const DETAIL: usize = 24;
const POINTS: usize = 7;

/// The look of a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// A heading with a rule.
    Title,
    Plain,
    Muted,
    /// An objective that is met.
    Met,
    /// An objective that was not reached.
    Missed,
    /// An obstacle.
    Warning,
    /// What to do next.
    Hint,
    /// The newest requested hint.
    AskedHint,
}

/// One line of the room.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PageLine {
    pub tone: Tone,
    pub text: String,
}

/// The lines of one column, or of two on a wide screen; empty without a mission.
pub fn columns(state: &State, locale: &Locale, width: u16) -> Vec<Vec<PageLine>> {
    let Some(mission) = shown(state) else {
        return Vec::new();
    };
    let width = usize::from(width);
    let two = width >= usize::from(TWO_COLUMNS);
    let room = if two { (width - 5) / 2 } else { width - 2 };
    let page = || Page {
        state,
        locale,
        mission,
        width: room.min(WIDEST),
        lines: Vec::new(),
    };
    let mut first = page();
    first.brief();
    first.launch();
    first.points();
    first.tries();
    first.career();
    if two {
        first.hints();
        let mut second = page();
        second.tasks();
        vec![first.lines, second.lines]
    } else {
        first.objectives();
        first.hints();
        first.rules();
        first.scoring();
        vec![first.lines]
    }
}

/// What a mission asks for: objectives, rules and scoring, in lines of at most so many columns.
pub fn tasks(state: &State, mission: &Listing, locale: &Locale, width: u16) -> Vec<PageLine> {
    let mut page = Page {
        state,
        locale,
        mission,
        width: usize::from(width).min(WIDEST),
        lines: Vec::new(),
    };
    page.tasks();
    page.lines
}

struct Page<'a> {
    state: &'a State,
    locale: &'a Locale,
    mission: &'a Listing,
    width: usize,
    lines: Vec<PageLine>,
}

impl Page<'_> {
    fn add(&mut self, tone: Tone, text: impl Into<String>) {
        self.lines.push(PageLine {
            tone,
            text: text.into(),
        });
    }

    /// A heading, with space above it.
    fn title(&mut self, text: &Text) {
        if !self.lines.is_empty() {
            self.add(Tone::Plain, "");
        }
        self.add(Tone::Title, self.locale.text(text));
    }

    fn paragraph(&mut self, tone: Tone, text: &str) {
        for line in wrap(text, self.width) {
            self.add(tone, line);
        }
    }

    fn brief(&mut self) {
        self.title(&self.mission.title.clone());
        let brief = reflow(&self.locale.text(&self.mission.brief));
        self.paragraph(Tone::Plain, &brief);
        if self.awaits_launch() {
            return;
        }
        self.add(Tone::Plain, "");
        let course = self.locale.text(&self.course());
        self.add(Tone::Muted, course);
    }

    /// The progress of the flight.
    fn course(&self) -> Text {
        let Some(progress) = &self.state.session.mission else {
            return text!(
                "mission-begin",
                fly = self.state.key(Action::Submit),
                back = self.state.key(Action::Escape)
            );
        };
        let so_far = progress.score_so_far;
        let score = so_far.map_or("-".to_owned(), |so_far| so_far.to_string());
        let elapsed = clock(progress.elapsed);
        if self.state.session.over {
            return text!(
                "mission-ended",
                elapsed = elapsed,
                score = score,
                key = self.state.key(Action::Show(Room::Debrief))
            );
        }
        let limit = clock(progress.limit);
        text!(
            "mission-under-way",
            elapsed = elapsed,
            limit = limit,
            score = score
        )
    }

    fn tasks(&mut self) {
        self.objectives();
        self.rules();
        self.scoring();
    }

    fn objectives(&mut self) {
        self.title(&text!("mission-objectives"));
        let required = self.locale.say("mission-required");
        let rows: Vec<Row> = (0..self.mission.objectives.len())
            .map(|at| self.row(at))
            .collect();
        let widest = rows.iter().map(|row| row.detail.width()).max();
        let detail = widest.unwrap_or(0).min(DETAIL);
        let rest = 4 + 1 + detail + 1 + POINTS + 2 + required.width();
        let room = self.width.saturating_sub(rest);
        for row in rows {
            let wrapped = wrap(&row.title, room);
            let mut title = wrapped.iter();
            let line = format!(
                "{} {} {} {:>POINTS$}  {}",
                row.mark,
                padded(title.next().map_or("", String::as_str), room),
                padded(&row.detail, detail),
                row.points,
                if row.required { &required } else { "" }
            );
            self.add(row.tone, line.trim_end());
            for rest in title {
                self.add(row.tone, format!("    {rest}"));
            }
        }
    }

    /// An objective with its state; before the flight, its target.
    fn row(&self, at: usize) -> Row {
        let objective = &self.mission.objectives[at];
        let progress = self.state.session.mission.as_ref();
        let now = progress.and_then(|progress| progress.objectives.get(at));
        let (mark, tone) = match now.map(|now| now.state) {
            None | Some(ObjectiveState::Open) => ("[ ]", Tone::Plain),
            Some(ObjectiveState::Met) => ("[x]", Tone::Met),
            Some(ObjectiveState::Missed) => ("[!]", Tone::Missed),
        };
        let detail = now.map(|now| &now.detail).filter(|now| !now.is_empty());
        let value = objective.value;
        Row {
            mark,
            tone,
            title: self.locale.text(&objective.title),
            detail: self.locale.text(detail.unwrap_or(&objective.target)),
            points: match now {
                // Adding 0 turns a negative zero into zero.
                Some(now) => format!("{:.0}/{value:.0}", value * now.fraction + 0.0),
                None => format!("{value:.0}"),
            },
            required: objective.mandatory,
        }
    }

    /// The key that opens the command line with a text.
    fn words_key(&self, words: &'static str) -> Text {
        let place = Place::In(Room::Mission);
        self.state.keymap.key(Meaning::words(words), place)
    }

    fn hints(&mut self) {
        let hints = &self.state.rooms.mission.hints;
        let clues = self.state.session.mission.as_ref().map(|it| &it.clues);
        let given = clues.map_or(&[][..], |clues| &clues.given);
        let next = clues
            .and_then(|clues| clues.price(self.words_key("hint")))
            .filter(|_| !self.state.session.over);
        // Before launch, the next step is shown with the questions.
        let more = !hints.is_empty() || next.is_some();
        if given.is_empty() && (self.awaits_launch() || !more) {
            return;
        }
        self.title(&text!("mission-hints"));
        for (at, (level, clue)) in given.iter().enumerate() {
            let hint = text!("mission-hint-of", level = *level, hint = clue);
            let clue = self.locale.text(&hint);
            let is_newest = at + 1 == given.len();
            let tone = if is_newest {
                Tone::AskedHint
            } else {
                Tone::Plain
            };
            self.paragraph(tone, &clue);
        }
        if self.awaits_launch() {
            return;
        }
        if let Some(next) = next {
            let next = self.locale.text(&next);
            self.paragraph(Tone::Muted, &next);
        }
        let last = hints.len().saturating_sub(1);
        for (at, hint) in hints.iter().enumerate() {
            let going_on = at == last && !self.state.session.over;
            let tone = if going_on { Tone::Hint } else { Tone::Muted };
            let hint = self.locale.text(hint);
            self.paragraph(tone, &hint);
        }
    }

    fn rules(&mut self) {
        let mission = self.mission;
        self.title(&text!("mission-rules"));
        let wind = mission.wind();
        let mut rows = vec![
            (
                text!("mission-rule-time"),
                text!(
                    "mission-rule-time-is",
                    limit = clock(mission.time_limit),
                    par = clock(mission.par_time)
                ),
            ),
            (
                text!("mission-rule-energy"),
                text!(
                    "mission-rule-energy-is",
                    par = format!("{:.1}", mission.par_energy_wh)
                ),
            ),
            (
                text!("mission-rule-height"),
                text!(
                    "mission-rule-height-is",
                    height = format!("{:.0}", mission.max_height_m)
                ),
            ),
            (
                text!("mission-rule-battery"),
                text!(
                    "mission-rule-battery-is",
                    percent = format!("{:.0}", mission.land_reserve_percent)
                ),
            ),
            (text!("mission-rule-wind"), wind),
            (
                text!("mission-rule-drones"),
                mission.vehicles.to_string().into(),
            ),
        ];
        rows.extend(self.fits());
        rows.extend(self.zones());
        self.rows(&rows);
    }

    fn scoring(&mut self) {
        let mission = self.mission;
        self.title(&text!("mission-scoring"));
        let weight = |(name, weight): &(Text, f64)| {
            let points = format!("{:.0}", weight * 1000.0);
            Text::joined(" ", vec![name.clone(), points.into()])
        };
        let weights = mission.weights.iter().map(weight).collect();
        let medals = text!(
            "mission-medals-are",
            gold = mission.medals.gold,
            silver = mission.medals.silver,
            bronze = mission.medals.bronze
        );
        let mut rows = vec![
            (text!("mission-weights"), Text::joined(", ", weights)),
            (text!("mission-medals"), medals),
        ];
        if !mission.gold_requires.is_empty() {
            let gates = Text::joined(", ", mission.gold_requires.clone());
            rows.push((text!("mission-gold-needs"), gates));
        }
        rows.extend(self.rewards());
        self.rows(&rows);
    }

    /// Adds names with their values beside them.
    fn rows(&mut self, rows: &[(Text, Text)]) {
        let plain = rows
            .iter()
            .map(|(name, what)| (name.clone(), what.clone(), Tone::Plain));
        self.toned_rows(&plain.collect::<Vec<_>>());
    }

    /// The same, each in its own tone.
    fn toned_rows(&mut self, rows: &[(Text, Text, Tone)]) {
        let names: Vec<String> = rows
            .iter()
            .map(|(name, ..)| self.locale.text(name))
            .collect();
        let indent = names.iter().map(|name| name.width()).max().unwrap_or(0) + 2;
        for (name, (_, what, tone)) in names.iter().zip(rows) {
            let what = self.locale.text(what);
            let mut lead = padded(name, indent);
            for line in wrap(&what, self.width.saturating_sub(indent)) {
                self.add(*tone, lead + &line);
                lead = " ".repeat(indent);
            }
        }
    }
}

/// One objective as text.
struct Row {
    mark: &'static str,
    tone: Tone,
    title: String,
    detail: String,
    points: String,
    required: bool,
}

/// A text padded with blanks to at least `width` columns.
fn padded(text: &str, width: usize) -> String {
    let gap = width.saturating_sub(text.width());
    format!("{text}{}", " ".repeat(gap))
}

fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    format!("{:02}:{:02}", seconds / 60, seconds % 60)
}
