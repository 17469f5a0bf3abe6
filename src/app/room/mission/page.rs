//! The mission's page, line by line.

use std::time::Duration;

use unicode_width::UnicodeWidthStr as _;

use super::shown;
use crate::app::State;
use crate::app::action::Action;
use crate::app::keymap::{Meaning, Place};
use crate::app::room::Room;
use crate::app::room::page::{PageLine, TextPage, Tone, padded};
use crate::mission::{Listing, ObjectiveState};
use crate::text;
use crate::text::{Locale, Text, reflow, wrap};

mod career;
mod fits;
mod launch;
mod points;
mod rewards;
mod tries;
mod workload;

/// The minimum width for two columns.
const TWO_COLUMNS: u16 = 110;
const WIDEST: usize = 88;
/// The maximum number of columns for the state of an objective.
const DETAIL: usize = 24;

/// The lines of one column, or of two if the screen is wide enough. Empty without a mission.
pub fn columns(state: &State, locale: &Locale, width: u16) -> Vec<Vec<PageLine>> {
    let Some(mission) = shown(state) else {
        return Vec::new();
    };
    let width = usize::from(width);
    let two = width >= usize::from(TWO_COLUMNS);
    let room = if two { (width - 5) / 2 } else { width - 2 };
    let page = || MissionPage {
        state,
        mission,
        text: TextPage::new(locale, room.min(WIDEST)),
    };
    let mut first = page();
    first.brief();
    first.launch();
    first.points();
    if !two {
        first.objectives();
    }
    first.tries();
    first.career();
    if two {
        first.hints();
        let mut second = page();
        second.tasks();
        vec![first.text.finish(), second.text.finish()]
    } else {
        first.workload();
        first.hints();
        first.rules();
        first.scoring();
        vec![first.text.finish()]
    }
}

/// The objectives, rules and scoring of a mission, in lines of at most `width` columns.
pub fn tasks(state: &State, mission: &Listing, locale: &Locale, width: u16) -> Vec<PageLine> {
    let mut page = MissionPage {
        state,
        mission,
        text: TextPage::new(locale, usize::from(width).min(WIDEST)),
    };
    page.tasks();
    page.text.finish()
}

struct MissionPage<'a> {
    state: &'a State,
    mission: &'a Listing,
    text: TextPage<'a>,
}

impl MissionPage<'_> {
    fn brief(&mut self) {
        self.text.title(&self.mission.title.clone());
        let brief = reflow(&self.text.locale.text(&self.mission.brief));
        self.text.paragraph(Tone::Plain, &brief);
        // A member of a crew does not begin the host's mission.
        let is_before = self.state.session.task.progress.is_none();
        if self.awaits_launch() || is_before && self.state.is_following() {
            return;
        }
        self.text.add(Tone::Plain, "");
        let course = self.text.locale.text(&self.course());
        self.text.add(Tone::Muted, course);
    }

    /// The progress of the flight.
    fn course(&self) -> Text {
        let Some(progress) = &self.state.session.task.progress else {
            return text!(
                "mission-begin",
                fly = self.state.key(Action::Submit),
                back = self.state.key(Action::Escape)
            );
        };
        let so_far = progress.score_so_far;
        let score = so_far.map_or("-".to_owned(), |so_far| so_far.to_string());
        let elapsed = clock(progress.elapsed);
        if self.state.session.task.over {
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
        self.workload();
        self.rules();
        self.scoring();
    }

    fn objectives(&mut self) {
        self.text.title(&text!("mission-objectives"));
        let required = self.text.locale.say("mission-required");
        let rows: Vec<ObjectiveRow> = (0..self.mission.objectives.len())
            .map(|at| self.row(at))
            .collect();
        let widest = |of: fn(&ObjectiveRow) -> &str| {
            let widths = rows.iter().map(|row| of(row).width());
            widths.max().unwrap_or(0)
        };
        let points = widest(|row| &row.points);
        let rest = 4 + 2 + 2 + points + 2 + required.width();
        let shared = self.text.width.saturating_sub(rest);
        // Columns that no title needs belong to the states.
        let free = shared.saturating_sub(widest(|row| &row.title));
        let detail = widest(|row| &row.detail).min(DETAIL.min(shared / 2).max(free));
        for row in rows {
            let required = if row.required { &required } else { "" };
            self.objective(&row, [shared - detail, detail, points], required);
        }
    }

    /// Adds an objective: its name, its state and its points in columns of these widths; longer names and states are wrapped.
    fn objective(&mut self, row: &ObjectiveRow, [room, detail, right]: [usize; 3], required: &str) {
        let (title, state) = (wrap(&row.title, room), wrap(&row.detail, detail));
        let part = |lines: &[String], at: usize, width| {
            padded(lines.get(at).map_or("", String::as_str), width)
        };
        for at in 0..title.len().max(state.len()).max(1) {
            let (title, state) = (part(&title, at, room), part(&state, at, detail));
            let line = if at == 0 {
                let (mark, points) = (row.mark, &row.points);
                format!("{mark} {title}  {state}  {points:>right$}  {required}")
            } else {
                format!("    {title}  {state}")
            };
            self.text.add(row.tone, line.trim_end());
        }
    }

    /// An objective with its state; before the flight, its target.
    fn row(&self, at: usize) -> ObjectiveRow {
        let objective = &self.mission.objectives[at];
        let progress = self.state.session.task.progress.as_ref();
        let now = progress.and_then(|progress| progress.objectives.get(at));
        let (mark, tone) = match now.map(|now| now.state) {
            None | Some(ObjectiveState::Open) => ("[ ]", Tone::Plain),
            Some(ObjectiveState::Met) => ("[x]", Tone::Met),
            Some(ObjectiveState::Missed) => ("[!]", Tone::Missed),
        };
        let detail = now.map(|now| &now.detail).filter(|now| !now.is_empty());
        let value = objective.value;
        ObjectiveRow {
            mark,
            tone,
            title: self.text.locale.text(&objective.title),
            detail: self.text.locale.text(detail.unwrap_or(&objective.target)),
            points: match now {
                // Adding 0 turns a negative zero into zero.
                Some(now) => format!("{:.0}/{value:.0}", value * now.fraction + 0.0),
                None => format!("{value:.0}"),
            },
            required: objective.mandatory,
        }
    }

    fn words_key(&self, words: &'static str) -> Text {
        let place = Place::In(Room::Mission);
        self.state.keymap.key(Meaning::words(words), place)
    }

    fn hints(&mut self) {
        let hints = &self.state.rooms.mission.hints;
        let clues = self
            .state
            .session
            .task
            .progress
            .as_ref()
            .map(|it| &it.clues);
        let given = clues.map_or(&[][..], |clues| &clues.given);
        let next = clues
            .and_then(|clues| clues.price(self.words_key("hint")))
            .filter(|_| !self.state.session.task.over && self.state.replay.is_none());
        // Before launch, the next step is shown with the questions.
        let more = !hints.is_empty() || next.is_some();
        if given.is_empty() && (self.awaits_launch() || !more) {
            return;
        }
        self.text.title(&text!("mission-hints"));
        for (at, (level, clue)) in given.iter().enumerate() {
            let hint = text!("mission-hint-of", level = *level, hint = clue);
            let clue = self.text.locale.text(&hint);
            let is_newest = at + 1 == given.len();
            let tone = if is_newest {
                Tone::AskedHint
            } else {
                Tone::Plain
            };
            self.text.paragraph(tone, &clue);
        }
        if self.awaits_launch() {
            return;
        }
        if let Some(next) = next {
            let next = self.text.locale.text(&next);
            self.text.paragraph(Tone::Muted, &next);
        }
        let last = hints.len().saturating_sub(1);
        for (at, hint) in hints.iter().enumerate() {
            let going_on = at == last && !self.state.session.task.over;
            let tone = if going_on { Tone::Hint } else { Tone::Muted };
            let hint = self.text.locale.text(hint);
            self.text.paragraph(tone, &hint);
        }
    }

    fn rules(&mut self) {
        let mission = self.mission;
        self.text.title(&text!("mission-rules"));
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
        self.text.rows(&rows);
    }

    fn scoring(&mut self) {
        let mission = self.mission;
        self.text.title(&text!("mission-scoring"));
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
        self.text.rows(&rows);
    }
}

struct ObjectiveRow {
    mark: &'static str,
    tone: Tone,
    title: String,
    detail: String,
    points: String,
    required: bool,
}

fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    format!("{:02}:{:02}", seconds / 60, seconds % 60)
}
