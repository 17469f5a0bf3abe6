//! The console without a screen: lines in, lines out, for screen readers and for pipes.
//!
//! It is the same console, with the same [`App`](crate::app::App) and session. Notices, outcomes of
//! commands, the state of objectives and the debrief, which a screen would show, are printed as
//! lines, each once. The output is plain text.
//!
//! A person's lines are carried out at once. From a pipe, the first line waits until the vehicles
//! are ready. Each further line waits until the earlier commands have ended, and `wait` can delay
//! it further. A question is answered by the next line: the answer that it names, or `no`; any
//! other line is a command, and the question counts as a failure. The end of the pipe ends the
//! flight. Outside of missions, a failed line makes the whole flight fail.

use std::time::Duration;

use super::api::Programs;
use super::signals::{Happened, Signals};
use super::{Console, ConsoleOptions, Opening, Pace, key, open_class, open_crew};
use crate::app::event::TerminalEvent;
use crate::app::state::{CrewLink, Overlay, Room};
use crate::diagnostic::Diagnostic;
use crate::language::{self, ConsoleLine, Meaning, Report, Scope};
use crate::scoring::FlownBy;
use crate::text::{Text, text};
use crate::vehicle::Severity;
use crossterm::event::KeyCode;

mod brief;
mod end;
mod input;
mod member;
mod output;
mod report;
mod wait;

use end::{Beginning, Patience, START_PATIENCE};
use input::{PlainLine, is_said};
use member::DebriefTold;
use output::PlainOutput;
use report::PlainReport;
use wait::PlainWait;

/// The time between news, so that reports of several vehicles are merged into one line.
const NEWS_EVERY: Duration = Duration::from_millis(500);
/// How long the console waits after the end of the input for a mission that ends on its own: longer than reports need to
/// become final.
const LANDING_PATIENCE: Duration = Duration::from_secs(60);

/// The line with which a script answers a question with no.
const NO: &str = "no";

/// Runs the plain console until its user quits or its input ends. Returns whether the mission was passed, or without a
/// mission, whether all lines from a pipe were carried out.
///
/// # Errors
/// The session could not be started, the output is closed, or the flight could not be stored.
pub async fn run(options: ConsoleOptions) -> anyhow::Result<bool> {
    let is_person = options.typed_by == FlownBy::Hand;
    let mut signals = Signals::new()?;
    let mut programs = Programs::open(options.api.as_ref())?;
    let mut class = open_class(&options).await?;
    let mut crew = open_crew(&options)?;
    let mut plain = Plain::new(options, is_person);
    plain.begin().await;
    let mut lines = input::read();
    let mut pace = Pace::of(plain.console.speedup());
    let mut told_to_end = false;
    while !plain.is_over() {
        let takes_lines = plain.takes_lines();
        pace.keep(plain.console.speedup());
        tokio::select! {
            biased;
            happened = signals.next() => match happened {
                Happened::End => {
                    told_to_end = true;
                    break;
                }
                Happened::Stopped => crate::terminal::stop(),
                Happened::Continued | Happened::Resized => {}
            },
            () = pace.tick() => plain.tick().await?,
            arrival = programs.next() => plain.console.serve(&mut programs, arrival).await,
            arrival = class.next() => plain.console.attend(&mut class, arrival).await,
            arrival = crew.next() => plain.console.attend_crew(&mut crew, arrival).await,
            line = lines.recv(), if takes_lines => match line {
                Some(line) => plain.take(&line).await?,
                None => plain.end_of_input().await,
            },
        }
        programs.tell(plain.console.app.state());
        class.carry_out(std::mem::take(&mut plain.console.class_work));
        plain.console.tell_class(&mut class, &|| None);
        plain.console.tell_crew(&mut crew);
    }
    plain.console.close().await;
    plain.console.tell_crew(&mut crew);
    plain.console.hand_in_rest(&mut class).await;
    class.close().await;
    crew.close().await;
    programs.close(plain.console.app.state()).await;
    plain.finish(told_to_end)
}

/// The console without a screen, with what it has printed.
pub(super) struct Plain {
    pub(super) console: Console,
    report: PlainReport,
    output: PlainOutput,
    wait: PlainWait,
    beginning: Beginning,
    is_person: bool,
    ended: bool,
    /// When the news was printed last: by the clock of the session, and by the wall clock.
    said_at: Duration,
    said_wall: Duration,
    /// The time limit for vehicles that do not start.
    start: Patience,
    /// The time limit for a mission that is about to end.
    landing: Patience,
    /// Whether the vehicles did not start, or a line from a pipe failed.
    failed: bool,
    /// At a member of a crew: the mission of the host whose brief was printed last.
    briefed: Option<String>,
    /// At a member of a crew: the record of the host that is followed.
    followed: Option<String>,
    debrief_told: DebriefTold,
}

impl Plain {
    pub(super) fn new(options: ConsoleOptions, is_person: bool) -> Self {
        Self {
            beginning: Beginning::of(&options, is_person),
            console: Console::new(options, false),
            report: PlainReport::default(),
            output: PlainOutput::start(is_person),
            wait: PlainWait::default(),
            is_person,
            ended: false,
            said_at: Duration::ZERO,
            said_wall: Duration::ZERO,
            start: Patience::new(START_PATIENCE),
            landing: Patience::new(LANDING_PATIENCE),
            failed: false,
            briefed: None,
            followed: None,
            debrief_told: DebriefTold::NotYet,
        }
    }

    /// Opens the console, and greets its user.
    pub(super) async fn begin(&mut self) {
        // Nothing is drawn: every size is large enough.
        let (columns, rows) = (u16::MAX, u16::MAX);
        self.console
            .feed(TerminalEvent::Resize { columns, rows })
            .await;
        self.console.begin().await;
        self.greet();
    }

    fn greet(&mut self) {
        if let Some(activity) = self.console.app.state().session().activity() {
            self.say(&activity.title());
        }
        if let Some(place) = self.console.app.state().crew().member() {
            let text = place.awaited();
            self.say(&text);
        }
        self.say(&text!("plain-greeting"));
        if self.console.app.state().flown_mission().is_some() {
            self.brief();
        }
        self.output.prompt();
    }

    fn say(&mut self, text: &Text) {
        self.output.say(&self.console.sight.look, text);
    }

    pub(super) fn is_over(&self) -> bool {
        let state = self.console.app.state();
        // A member of a crew waits for the next flight of the host.
        let has_ended = match state.crew().member() {
            Some(place) => place.link(state.wall()) == CrewLink::Ended && self.has_played_all(),
            None => {
                state.rooms().debrief().session().is_some() || state.session().activity().is_none()
            }
        };
        self.console.over || has_ended
    }

    fn takes_lines(&self) -> bool {
        !self.ended && (self.is_person || (self.beginning.is_over() && self.is_idle()))
    }

    fn is_idle(&self) -> bool {
        let mut entries = self.console.app.state().session().ledger().entries();
        self.wait.is_over() && entries.all(crate::ledger::LedgerEntry::is_final)
    }

    pub(super) async fn tick(&mut self) -> anyhow::Result<()> {
        self.console.tick().await;
        let is_other_flight = self.follows_other();
        self.brief_member();
        // The plain console has neither bell nor desktop notifications.
        self.console.sight.bell = false;
        self.console.sight.notes.clear();
        self.hold();
        self.beginning.look(self.console.app.state());
        let now = self.console.app.state().now();
        let is_urgent = self.report.is_urgent(self.console.app.state());
        // Without the host, time stands at a member of a crew.
        let wall = self.console.app.state().wall();
        let waits = now
            .saturating_sub(self.said_at)
            .max(wall.saturating_sub(self.said_wall));
        if is_urgent || is_other_flight || waits >= NEWS_EVERY {
            (self.said_at, self.said_wall) = (now, wall);
            self.tell_news();
            if self.console.app.state().crew().member().is_some() {
                self.debrief();
            }
        }
        if !self.is_person
            && self
                .start
                .is_over(end::cannot_start(self.console.app.state()), now)
        {
            self.give_up();
        }
        let ends = self.ended && self.is_idle();
        let lands = end::ends_itself(self.console.app.state());
        if ends && (!lands || self.landing.is_over(true, now)) {
            self.abandon().await;
        }
        self.output.check()
    }

    /// Prints the debrief of the flight, if there is one that was not printed yet.
    fn debrief(&mut self) {
        let state = self.console.app.state();
        let debrief = state.rooms().debrief().session();
        let Some(debrief) = debrief.filter(|_| self.debrief_told == DebriefTold::NotYet) else {
            return;
        };
        self.debrief_told = DebriefTold::Told;
        for line in debrief.lines(state.training().reward(), state.locale()) {
            self.say(&Text::from(line.text.as_str()));
        }
        self.output.prompt();
    }

    fn tell_news(&mut self) {
        for text in self.report.news(self.console.app.state()) {
            self.say(&text);
        }
        self.output.prompt();
    }

    fn hold(&mut self) {
        for line in self.wait.look(self.console.app.state()) {
            self.say(&text!("plain-wait-in-vain", line = line));
            self.failed = true;
        }
    }

    async fn take(&mut self, line: &PlainLine) -> anyhow::Result<()> {
        self.output.line_ended();
        match line {
            // An empty line or a comment of a script answers no question.
            PlainLine::Read(line) if !self.is_person && !is_said(line.trim()) => return Ok(()),
            PlainLine::Read(line) => self.take_text(line.trim()).await,
            PlainLine::Garbled(line) => {
                self.tell_news();
                self.say(&text!("plain-garbled", line = line.trim()));
                self.failed = true;
            }
        }
        self.tell_outcome().await;
        self.output.prompt();
        self.output.check()
    }

    async fn take_text(&mut self, line: &str) {
        if let Some(Overlay::Confirm(question)) = self.console.app.state().overlay() {
            let answer = question.answer().to_owned();
            self.answer(&answer, line).await;
            if self.is_person || line == answer || line == NO {
                return;
            }
            // Any other line of a script is a command, not an answer.
            self.unconfirmed(&answer).await;
        }
        if is_said(line) {
            if !self.is_person {
                // The results of earlier lines are printed before this one.
                self.tell_news();
                self.say(&Text::from(format!("> {line}")));
            }
            if !self.carry_out_here(line) {
                self.console
                    .feed(TerminalEvent::Line(line.to_owned()))
                    .await;
            }
        }
    }

    /// Reports a question in a pipe that the next line has not answered: the action is not carried out, which counts as
    /// a failure.
    async fn unconfirmed(&mut self, answer: &str) {
        self.failed = true;
        self.console.feed(TerminalEvent::Told).await;
        self.say(&text!("plain-unconfirmed", answer = answer));
    }

    /// Answers an open question; only the exact answer confirms it.
    async fn answer(&mut self, answer: &str, line: &str) {
        if line == answer {
            for c in answer.chars() {
                self.console.feed(key(KeyCode::Char(c))).await;
            }
        } else {
            self.console.feed(key(KeyCode::Esc)).await;
        }
    }

    /// Prints the result of a line, as a screen would show it.
    async fn tell_outcome(&mut self) {
        let state = self.console.app.state();
        let mut texts = Vec::new();
        if let Some(message) = state.message() {
            self.failed |= message.severity <= Severity::Error;
            texts.push(message.text.clone());
        }
        match state.overlay() {
            Some(Overlay::Confirm(question)) => texts.push(text!(
                "plain-asks",
                question = question.question(),
                reason = question.reason(),
                answer = question.wanted()
            )),
            Some(Overlay::Palette(palette)) => {
                self.failed |= palette.fault().is_some();
                texts.extend(palette.fault().into_iter().map(explained));
            }
            // Prompts, lists and the help are for screens only.
            Some(
                Overlay::Prompt(_)
                | Overlay::Profiles { .. }
                | Overlay::Sticks(_)
                | Overlay::Help(_)
                | Overlay::Log { .. },
            )
            | None => {}
        }
        // A line that leads to another room has nothing to print here.
        if state.session().activity().is_some()
            && state.rooms().debrief().session().is_none()
            && state.room() != Room::Fly
        {
            texts.push(text!("plain-no-room"));
        }
        self.console.feed(TerminalEvent::Told).await;
        for text in texts {
            self.say(&text);
        }
    }

    /// Carries out a line that requests a report or a wait; returns `false` for any other line.
    fn carry_out_here(&mut self, line: &str) -> bool {
        let state = self.console.app.state();
        // Faults are reported where all lines are handled.
        let Ok(statement) = state.with_context(|context| language::parse(line, context)) else {
            return false;
        };
        let texts = match statement.meaning {
            _ if statement.scope == Scope::Screen => vec![text!("plain-no-room")],
            Meaning::Wait(_) => {
                self.wait(line);
                Vec::new()
            }
            Meaning::Console(ConsoleLine::Report(Report::Brief))
                if state.flown_mission().is_none() =>
            {
                return false;
            }
            Meaning::Console(ConsoleLine::Report(report)) => report::texts(&report, state),
            Meaning::Console(_) | Meaning::Act(_) => return false,
        };
        for text in texts {
            self.say(&text);
        }
        true
    }

    fn brief(&mut self) {
        for text in brief::lines(self.console.app.state()) {
            self.say(&text);
        }
    }

    /// Delays the following lines.
    fn wait(&mut self, line: &str) {
        let begun = self.wait.begin(line, self.console.app.state());
        for fault in begun.err().into_iter().flatten() {
            self.failed = true;
            self.say(&explained(&fault));
        }
    }

    async fn end_of_input(&mut self) {
        self.ended = true;
        if let Some(Overlay::Confirm(question)) = self.console.app.state().overlay() {
            let answer = question.answer().to_owned();
            self.console.feed(key(KeyCode::Esc)).await;
            if self.is_person {
                self.tell_outcome().await;
            } else {
                self.unconfirmed(&answer).await;
            }
        }
    }

    fn finish(mut self, told_to_end: bool) -> anyhow::Result<bool> {
        for text in self.report.news(self.console.app.state()) {
            self.say(&text);
        }
        let is_mission = matches!(self.console.options.opening, Opening::Mission(_));
        let failed = self.failed || end::has_failures(self.console.app.state().session().ledger());
        let mut passed = !is_mission && (self.is_person || !failed);
        let state = self.console.app.state();
        if let Some(debrief) = state.rooms().debrief().session() {
            passed = debrief.report().passed;
        }
        self.debrief();
        self.output.finish(told_to_end)?;
        self.console.require_joined()?;
        self.console.require_stored()?;
        Ok(passed)
    }
}

fn explained(fault: &Diagnostic) -> Text {
    let help = fault.help.clone();
    Text::joined(
        "; ",
        std::iter::once(fault.message.clone()).chain(help).collect(),
    )
}
