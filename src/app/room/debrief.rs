//! The debrief of a flight.

use std::time::Duration;

use crossterm::event::KeyCode;

use crate::app::State;
use crate::app::action::{Action, DebriefAction, ReplayAction, StartAction, Step};
use crate::app::keymap::{ESCAPE, KeyHint, KeyRow, Press, does, hint, key};
use crate::app::room::home::fly_drill;
use crate::app::room::{Answer, Room, RoomModel, RoomRequest, footer_keys};
use crate::app::state::{Career, Heights};
use crate::campaign::Reward;
use crate::debrief::{self, DebriefCareer, DebriefLine, DebriefTone};
use crate::mission::Listing;
use crate::notice::sanitised;
use crate::scoring::{Report, TruthReport};
use crate::text;
use crate::text::Locale;
use crate::vehicle::Severity;

/// How long keys are ignored after the debrief opens, because they may still be meant for the
/// flight.
const DEAF: Duration = Duration::from_secs(1);

/// The width of the text in columns.
pub const TEXT_WIDTH: u16 = 80;
/// The minimum width in columns of the map of the truth beside the text.
const TRUTH_LEAST: u16 = 60;
/// The minimum number of screen rows for a summary with the height curve.
const TALL: u16 = 36;
/// Rows of the head of a summary with the height curve.
const SUMMARY_HEAD: u16 = 4;
/// The minimum number of rows for the components of a summary with the height curve.
const SUMMARY_LEAST: u16 = 6;
/// The maximum number of rows for the components of a summary with the height curve.
const SUMMARY_MOST: u16 = 10;
/// Rows of a compact summary besides its components: title, outcome, strip and a blank line.
const COMPACT_HEAD: u16 = 4;

#[derive(Debug, Clone)]
pub struct Debrief {
    pub(in crate::app) report: Box<Report>,
    /// The first line shown.
    pub(in crate::app) scroll: usize,
    /// Whether the map of the truth replaces the text, on a screen too narrow for both.
    pub(in crate::app) map: bool,
    /// When the debrief opened; keys are ignored for a short time after that.
    pub(in crate::app) since: Duration,
    /// The greatest height of any vehicle in metres, at equal intervals.
    pub(in crate::app) heights: Heights,
}

/// The debrief of the session, and the last one before it.
#[derive(Debug, Clone, Default)]
pub struct Debriefs {
    /// The debrief of the session; in a replay, of the recorded flight.
    pub(in crate::app) session: Option<Debrief>,
    /// The last debrief of an earlier session in this run of the program.
    earlier: Option<Debrief>,
    /// The rewards of that session.
    earlier_reward: Option<Reward>,
}

impl Debriefs {
    /// The debrief of the session; in a replay, of the recorded flight.
    pub fn session(&self) -> Option<&Debrief> {
        self.session.as_ref()
    }

    /// The debrief that the room shows.
    pub fn shown(&self) -> Option<&Debrief> {
        if self.shows_earlier() {
            self.earlier.as_ref()
        } else {
            self.session.as_ref()
        }
    }

    pub(in crate::app) fn shown_mut(&mut self) -> Option<&mut Debrief> {
        if self.shows_earlier() {
            self.earlier.as_mut()
        } else {
            self.session.as_mut()
        }
    }

    /// Whether the debrief shown is from before the session. A replay of that flight does not replace it, since it has
    /// no rewards.
    pub fn shows_earlier(&self) -> bool {
        match (&self.session, &self.earlier) {
            (_, None) => false,
            (None, Some(_)) => true,
            (Some(session), Some(earlier)) => session.is_of_flight(earlier),
        }
    }

    /// Stores the debrief of the session, which replaces the earlier one unless it is that of a replay.
    pub(in crate::app) fn store(&mut self, debrief: Debrief, is_replay: bool) {
        if !is_replay {
            (self.earlier, self.earlier_reward) = (None, None);
        }
        self.session = Some(debrief);
    }

    /// Keeps the debrief of a session that is replaced by another one, with its rewards.
    pub(in crate::app) fn keep(&mut self, reward: Option<Reward>) {
        if let Some(debrief) = self.session.take() {
            (self.earlier, self.earlier_reward) = (Some(debrief), reward);
        }
    }

    /// Drops the debrief of a replay that ends, if there is an earlier one.
    pub(in crate::app) fn end_replay(&mut self) {
        if self.earlier.is_some() {
            self.session = None;
        }
    }
}

/// The result at a glance, above the text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Summary {
    pub rows: u16,
    /// Whether the components are stacked beside a curve of the height; otherwise they are in two columns above the
    /// strip.
    pub is_tall: bool,
}

impl Debrief {
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Whether both debriefs are those of one flight.
    fn is_of_flight(&self, other: &Self) -> bool {
        let facts = |it: &Self| {
            let report = &it.report;
            (report.seed, report.attempt, report.score, report.passed)
        };
        self.report.mission == other.report.mission && facts(self) == facts(other)
    }

    /// The first line shown.
    pub fn scroll(&self) -> usize {
        self.scroll
    }

    /// Whether the map of the truth replaces the text, on a screen too narrow for both.
    pub fn shows_map(&self) -> bool {
        self.map
    }

    /// The greatest height of any vehicle in metres, at equal intervals.
    pub fn heights(&self) -> &[Option<f64>] {
        self.heights.all()
    }

    /// The summary above the text, on a screen of this height.
    pub fn summary(&self, height: u16) -> Summary {
        let weighted = self.report.components.iter().filter(|it| it.weight > 0.0);
        let components = weighted.count() as u16;
        let is_tall = height >= TALL;
        let rows = if is_tall {
            SUMMARY_HEAD + components.clamp(SUMMARY_LEAST, SUMMARY_MOST)
        } else {
            COMPACT_HEAD + components.div_ceil(2)
        };
        Summary { rows, is_tall }
    }

    /// The lines of the result and of the rewards, in a language.
    pub fn lines(&self, reward: Option<&Reward>, locale: &Locale) -> Vec<DebriefLine> {
        let career = reward.map(|reward| DebriefCareer {
            changes: reward.lines(),
            next: reward.next.clone(),
        });
        let career = career.unwrap_or_default();
        let lines = debrief::lines_with(&self.report, &career, locale).into_iter();
        lines
            .map(|line| DebriefLine {
                text: sanitised(&line.text),
                ..line
            })
            .collect()
    }

    /// The lines below the summary, which shows the result.
    pub fn lines_below(&self, reward: Option<&Reward>, locale: &Locale) -> Vec<DebriefLine> {
        let mut lines = self.lines(reward, locale);
        lines.retain(|line| line.tone != DebriefTone::Head);
        lines
    }

    /// Whether a screen of this width shows the truth beside the text.
    pub fn is_beside(&self, width: u16) -> bool {
        width >= TEXT_WIDTH + TRUTH_LEAST && self.report.truth != TruthReport::default()
    }

    /// Whether a screen of this width shows the truth instead of the text.
    pub fn is_map(&self, width: u16) -> bool {
        self.map && !self.is_beside(width)
    }

    /// Whether the debrief opened so recently that keys are ignored.
    pub fn is_deaf(&self, now: Duration) -> bool {
        now.saturating_sub(self.since) < DEAF
    }
}

impl State {
    /// Whether the debrief opened so recently that keys are ignored.
    pub fn is_deaf(&self) -> bool {
        let debrief = self.rooms.debrief.shown();
        self.room == Room::Debrief && debrief.is_some_and(|debrief| debrief.is_deaf(self.wall))
    }

    /// The rewards of the flight whose debrief is shown.
    pub fn debrief_reward(&self) -> Option<&Reward> {
        if self.rooms.debrief.shows_earlier() {
            self.rooms.debrief.earlier_reward.as_ref()
        } else {
            self.training.reward.as_ref()
        }
    }
}

const HINTS: &[KeyHint] = &[
    footer_keys::SCROLL,
    hint(
        &[Action::Debrief(DebriefAction::NextSection)],
        "hint-section",
    ),
    hint(&[Action::Debrief(DebriefAction::TruthMap)], "hint-truth"),
    hint(&[Action::Again], "hint-new-try"),
    hint(&[Action::AgainAlike], "hint-alike"),
    hint(&[Action::Debrief(DebriefAction::NextMission)], "hint-next"),
    hint(&[Action::Replay(ReplayAction::ReviewNewest)], "hint-review"),
    hint(&[Action::Replay(ReplayAction::ReplayNewest)], "hint-replay"),
    hint(&[Action::Leave], "hint-home"),
    hint(&[Action::Start(StartAction::Drill)], "hint-drill"),
    footer_keys::COMMAND,
    footer_keys::HELP,
];

/// The key hints at a member of a crew.
const MEMBER_HINTS: &[KeyHint] = &[
    footer_keys::SCROLL,
    hint(
        &[Action::Debrief(DebriefAction::NextSection)],
        "hint-section",
    ),
    hint(&[Action::Debrief(DebriefAction::TruthMap)], "hint-truth"),
    hint(&[Action::Leave], "hint-leave-crew"),
    footer_keys::COMMAND,
    footer_keys::HELP,
];

const EMPTY_HINTS: &[KeyHint] = &[
    hint(&[Action::Leave], "hint-home"),
    footer_keys::COMMAND,
    footer_keys::HELP,
];

impl RoomModel for Debriefs {
    const KEYS: &'static [KeyRow] = &[
        does(key('r'), Action::Again),
        does(key('s'), Action::AgainAlike),
        does(key('n'), Action::Debrief(DebriefAction::NextMission)),
        does(key('t'), Action::Start(StartAction::Drill)),
        // In a replay, `m` lists the moments.
        does(key('g'), Action::Debrief(DebriefAction::TruthMap)),
        does(key('m'), Action::Debrief(DebriefAction::TruthMap)),
        does(key('v'), Action::Replay(ReplayAction::ReplayNewest)),
        does(key('a'), Action::Replay(ReplayAction::ReviewNewest)),
        does(key('h'), Action::Leave),
        does(key('q'), Action::Leave),
        does(ESCAPE, Action::Escape),
        does(
            Press::Plain(KeyCode::Tab),
            Action::Debrief(DebriefAction::NextSection),
        ),
        does(
            Press::Plain(KeyCode::BackTab),
            Action::Debrief(DebriefAction::PreviousSection),
        ),
    ];

    fn hints(state: &State) -> &'static [KeyHint] {
        match state.rooms.debrief.shown() {
            Some(_) if state.crew.member().is_some() => MEMBER_HINTS,
            Some(_) => HINTS,
            None => EMPTY_HINTS,
        }
    }

    fn step(state: &mut State, step: Step) -> Answer {
        turn(state, |scroll, _, positions| step.apply(scroll, positions));
        Some(Vec::new())
    }

    fn escape(state: &mut State) -> Answer {
        let width = state.display.size.0;
        let debrief = state.rooms.debrief.shown_mut();
        if let Some(debrief) = debrief.filter(|debrief| debrief.is_map(width)) {
            debrief.map = false;
            return Some(Vec::new());
        }
        let is_earlier = state.rooms.debrief.shows_earlier();
        // The review was only opened to explain this debrief.
        let is_reviewed = is_earlier && state.rooms.review.is_from_debrief;
        let is_under_way = match state.replay {
            Some(_) => !is_reviewed,
            None => is_earlier && state.session.activity.is_some(),
        };
        Some(vec![if is_under_way {
            RoomRequest::Show(Room::Fly)
        } else {
            RoomRequest::Leave
        }])
    }

    /// The last debrief stays until the next one.
    fn forget_session(&mut self) {
        self.session = None;
    }

    fn start(state: &mut State, action: StartAction) -> Answer {
        match action {
            StartAction::Drill => {
                let report = &state.rooms.debrief.shown()?.report;
                let flown = report.mission.clone();
                // After a failure, the text names this drill.
                let named = report.drill.clone().filter(|_| !report.passed);
                let mut all = state.training.missions.iter();
                let listed = named.filter(|drill| all.any(|it| it.id == *drill));
                Some(match listed {
                    Some(drill) => vec![RoomRequest::Fly(state.training().launch(&drill))],
                    None => fly_drill(state, &flown),
                })
            }
            StartAction::Daily | StartAction::Exam | StartAction::Practise => None,
        }
    }
}

pub(super) fn act(state: &mut State, action: DebriefAction) -> Vec<RoomRequest> {
    match action {
        DebriefAction::NextSection => turn(state, |scroll, sections, _| {
            let next = sections.iter().find(|&&line| line > scroll);
            next.copied().unwrap_or(0)
        }),
        DebriefAction::PreviousSection => turn(state, |scroll, sections, last| {
            let before = sections.iter().rfind(|&&line| line < scroll);
            before.or(sections.last()).copied().unwrap_or(last)
        }),
        DebriefAction::TruthMap => {
            if let Some(debrief) = state.rooms.debrief.shown_mut() {
                debrief.map = !debrief.map;
            }
        }
        DebriefAction::NextMission => return next_mission(state),
    }
    Vec::new()
}

/// Scrolls to the line that `to` computes from the current first line, the first lines of the
/// sections, and the number of possible first lines.
fn turn(state: &mut State, to: impl FnOnce(usize, &[usize], usize) -> usize) {
    let keys_above = u16::from(state.has_keys_above_replay());
    let height = state.display.size.1.saturating_sub(keys_above);
    let Some(debrief) = state.rooms.debrief.shown() else {
        return;
    };
    // The header and the footer take a row each.
    let free_rows = height.saturating_sub(2 + debrief.summary(height).rows);
    let rows = usize::from(free_rows);
    let lines = debrief.lines_below(state.debrief_reward(), &state.locale);
    let positions = (lines.len() + 1).saturating_sub(rows).max(1);
    let headings = lines
        .iter()
        .enumerate()
        .filter(|(_, line)| line.tone == DebriefTone::Heading);
    let sections: Vec<usize> = headings.map(|(at, _)| at.min(positions - 1)).collect();
    let scroll = to(debrief.scroll.min(positions - 1), &sections, positions);
    if let Some(debrief) = state.rooms.debrief.shown_mut() {
        debrief.scroll = scroll;
    }
}

/// Flies the recommended mission or drill; without a profile, the one after the mission just flown.
fn next_mission(state: &mut State) -> Vec<RoomRequest> {
    let career = state.training.career.as_ref();
    if let Some((_, next)) = career.and_then(Career::next) {
        return vec![RoomRequest::Fly(state.training().launch(&next.id))];
    }
    let debriefed = state.rooms.debrief.shown();
    let flown = debriefed.map(|debrief| debrief.report.mission.as_str());
    let of = |it: &Listing| it.drill_of.clone().unwrap_or_else(|| it.id.clone());
    let mut all = state.training.missions.iter();
    let flown = all.find(|it| Some(it.id.as_str()) == flown).map(of);
    let mut missions = state
        .training
        .missions
        .iter()
        .filter(|it| it.drill_of.is_none());
    let is_there = missions.any(|it| Some(&it.id) == flown.as_ref());
    let next = missions.next().filter(|_| is_there);
    let Some(id) = next.map(|next| next.id.clone()) else {
        state.say(Severity::Notice, text!("debrief-last-mission"));
        return Vec::new();
    };
    vec![RoomRequest::Fly(state.training().launch(&id))]
}
