//! Pauses and resumes a session.

use std::time::Duration;

use super::{Console, RunningSession};
use crate::app::effect::PaceChange;
use crate::app::event::{Event, SessionEvent};
use crate::notice::Notice;
use crate::record::{Happening, NoticeLine};
use crate::text;
use crate::text::Text;
use crate::text::lasting;
use crate::vehicle::Severity;

impl Console {
    /// Stops the simulator and the clock of all deadlines, link time-outs and the mission.
    pub(super) fn pause(&mut self) {
        let Some(running) = &self.running else {
            return;
        };
        running.hold(true);
        self.clock.stop();
        self.post(SessionEvent::Paused(true));
    }

    /// Resumes; does nothing unless paused.
    pub(super) fn go_on(&mut self) {
        let Some(lasted) = self.clock.go_on() else {
            return;
        };
        let now = self.clock.now();
        let was_read = std::mem::take(&mut self.awaits_reader);
        if !was_read {
            self.post(SessionEvent::Paused(false));
        }
        let Some(running) = &mut self.running else {
            return;
        };
        running.hold(false);
        running.rest(now);
        running.note_down(now, paused_for(lasted));
        // Reading the brief is not a pause.
        if !was_read && let Some(notice) = running.note_pause(lasted, now) {
            self.post(notice);
        }
    }

    /// Notes that the whole program was stopped, as by Ctrl-Z: with the embedded simulator, the
    /// stop counts as a pause.
    pub(super) fn note_stop(&mut self) {
        let Some(lasted) = self.clock.take_stopped() else {
            return;
        };
        let now = self.clock.now();
        let is_allowed = self.app.state().session().may_be_stopped();
        let Some(running) = &mut self.running else {
            return;
        };
        running.rest(now);
        running.note_down(now, paused_for(lasted));
        // The general notice below is shown in every session, so the notice for missions is not needed.
        let _ = running.note_pause(lasted, now);
        let time = lasting(lasted);
        let (severity, text) = if is_allowed {
            (Severity::Notice, text!("session-stopped", time = time))
        } else {
            (
                Severity::Warning,
                text!("session-stopped-rules", time = time),
            )
        };
        let notice = Notice::general(now, severity, text);
        running.note_down(now, Happening::Notice(NoticeLine::of(&notice)));
        self.post(notice);
    }

    /// Changes the speed-up of simulated time.
    pub(super) fn set_speedup(&mut self, change: PaceChange) {
        let now = self.clock.now();
        if let Some(running) = &mut self.running {
            running.set_speedup(change.speedup, now);
            let rate = change.speedup;
            running.note_down(now, Happening::Speedup { rate });
            self.post(SessionEvent::Speedup(change));
        }
    }

    /// The seconds of the vehicles' time per second of the program's time.
    pub(super) fn speedup(&self) -> f64 {
        let running = self.running.as_ref();
        running.map_or(self.options.speedup, RunningSession::speedup)
    }

    /// When a brief is first read, stops a mission in the embedded simulator once its vehicles are
    /// there. Resumes it when the trainee leaves the brief.
    pub(super) fn wait_for_reader(&mut self) {
        let session = self.app.state().session();
        let is_reading = session.is_reading();
        let vehicles = session.vehicles().len();
        if !is_reading && self.awaits_reader {
            self.go_on();
        }
        let Some(running) = &self.running else {
            return;
        };
        if is_reading && running.can_wait_for_reader(vehicles) && !self.awaits_reader {
            running.hold(true);
            self.clock.stop();
            self.awaits_reader = true;
        }
    }

    /// Triggers an inject, and shows its title, or why it cannot be triggered.
    pub(super) fn inject(&mut self, name: &str) {
        let flight = self.running.as_mut().and_then(RunningSession::instructed);
        let Some(flight) = flight else {
            return;
        };
        let event = match flight.inject(name) {
            Ok(text) => Event::Notice(Notice::general(
                self.clock.now(),
                Severity::Notice,
                text!("inject-done", what = text),
            )),
            Err(fault) => Event::Failed(Text::from(&fault)),
        };
        self.post(event);
    }

    /// Ends the mission; its report follows with the next tick.
    pub(super) fn abandon(&mut self) {
        self.go_on();
        self.running.iter_mut().for_each(RunningSession::abandon);
    }

    /// Ends the mission for the instructor; its report follows with the next tick.
    pub(super) fn stop(&mut self) {
        self.go_on();
        self.running.iter_mut().for_each(RunningSession::stop);
    }
}

fn paused_for(lasted: Duration) -> Happening {
    let ms = u64::try_from(lasted.as_millis()).unwrap_or(u64::MAX);
    Happening::Paused { ms }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use crossterm::event::KeyCode;

    use super::*;
    use crate::app::event::TerminalEvent;
    use crate::app::state::rate;
    use crate::mission::Mission;
    use crate::shell::pace::TICK;
    use crate::shell::{ConsoleOptions, Opening, key};
    use crate::text::Text;

    const FIRST: &str = include_str!("../../missions/00-first-flight.toml");

    /// A console that shows the brief of a mission.
    async fn reading() -> Console {
        Box::pin(reading_of(FIRST)).await
    }

    async fn reading_of(mission: &str) -> Console {
        let mission = Mission::parse(mission).expect("it is good");
        let options = ConsoleOptions::for_test(Opening::Mission(Arc::new(mission)));
        let mut console = Console::new(options, true);
        let (columns, rows) = (120, 40);
        console.feed(TerminalEvent::Resize { columns, rows }).await;
        console.begin().await;
        console
    }

    async fn run(console: &mut Console, seconds: u32) {
        for _ in 0..seconds * 10 {
            tokio::time::sleep(TICK).await;
            console.tick().await;
        }
    }

    fn elapsed(console: &Console) -> Duration {
        let progress = console.app.state().session().mission();
        progress.map_or(Duration::ZERO, |progress| progress.elapsed)
    }

    #[tokio::test(start_paused = true)]
    async fn a_mission_begins_when_its_brief_is_left_and_reading_is_no_pause() {
        let mut console = Box::pin(reading()).await;
        run(&mut console, 60).await;
        let (stood, session) = (console.clock.now(), console.app.state().session());
        assert!(session.is_reading() && !session.is_paused());
        assert_eq!(session.vehicles().len(), 1);
        assert!(stood < Duration::from_secs(5), "{stood:?}");
        assert_eq!(elapsed(&console), Duration::ZERO);
        console.feed(key(KeyCode::Enter)).await;
        run(&mut console, 5).await;
        let session = console.app.state().session();
        assert!(!session.is_reading() && !session.is_paused());
        let late = Duration::from_secs(5).saturating_sub(elapsed(&console));
        assert!(late < Duration::from_secs(1), "{late:?}");
        // A pause shows a message when it ends, but reading the brief does not.
        assert_eq!(console.app.state().message(), None);
    }

    #[tokio::test(start_paused = true)]
    async fn a_command_from_the_brief_begins_the_mission_and_a_pause_is_refused_before() {
        let mut console = Box::pin(reading()).await;
        run(&mut console, 5).await;
        console.feed(key(KeyCode::Char('p'))).await;
        assert!(!console.app.state().session().is_paused());
        assert_eq!(said(&console), Some(text!("pause-not-begun")));
        console
            .feed(TerminalEvent::Line("1 predict 800".to_owned()))
            .await;
        assert!(console.app.state().session().is_reading());
        console
            .feed(TerminalEvent::Line("1 guided".to_owned()))
            .await;
        run(&mut console, 3).await;
        assert!(elapsed(&console) > Duration::from_secs(1));
    }

    #[tokio::test(start_paused = true)]
    async fn a_brief_left_for_another_room_says_that_the_clock_runs() {
        let mut console = Box::pin(reading()).await;
        run(&mut console, 5).await;
        console.feed(key(KeyCode::Char('L'))).await;
        assert!(!console.app.state().session().is_reading());
        let expected = text!("mission-brief-left", key = Text::verbatim("p"));
        assert_eq!(said(&console), Some(expected));
    }

    #[tokio::test(start_paused = true)]
    async fn a_stop_of_the_whole_program_is_a_pause_and_loses_no_link() {
        let mut console = Box::pin(reading()).await;
        run(&mut console, 5).await;
        console.feed(key(KeyCode::Enter)).await;
        run(&mut console, 5).await;
        tokio::time::advance(Duration::from_secs(60)).await;
        run(&mut console, 5).await;
        let late = Duration::from_secs(10).saturating_sub(elapsed(&console));
        assert!(late < Duration::from_secs(1), "{late:?}");
        assert!(elapsed(&console) <= Duration::from_secs(10));
        let notices: Vec<String> = console
            .app
            .state()
            .notices()
            .lines()
            .map(|it| it.notice.text.to_string())
            .collect();
        assert!(
            notices.iter().any(|it| it.contains("suspended for 60 s")),
            "{notices:?}"
        );
        assert!(!notices.iter().any(|it| it.contains("link")), "{notices:?}");
    }

    #[tokio::test(start_paused = true)]
    async fn a_stop_where_pauses_are_not_allowed_is_a_warning() {
        let strict = FIRST.replacen("[rules]\n", "[rules]\npause = false\n", 1);
        assert_ne!(strict, FIRST);
        let mut console = Box::pin(reading_of(&strict)).await;
        run(&mut console, 5).await;
        console.feed(key(KeyCode::Enter)).await;
        run(&mut console, 5).await;
        tokio::time::advance(Duration::from_secs(8)).await;
        run(&mut console, 1).await;
        let mut lines = console.app.state().notices().lines();
        let warned = lines.find(|it| it.notice.severity == Severity::Warning);
        let words = warned.map(|it| it.notice.text.to_string());
        let words = words.unwrap_or_default();
        assert!(words.contains("allow no pause"), "{words}");
    }

    async fn say(console: &mut Console, line: &str) {
        console.feed(TerminalEvent::Line(line.to_owned())).await;
    }

    fn said(console: &Console) -> Option<Text> {
        console.app.state().message().map(|it| it.text.clone())
    }

    fn pace(console: &Console) -> String {
        rate(console.app.state().session().pace().now)
    }

    #[tokio::test(start_paused = true)]
    async fn time_passes_faster_until_an_order_has_been_carried_out() {
        let mut console = Box::pin(reading()).await;
        run(&mut console, 5).await;
        for line in ["1 guided", "1 arm"] {
            say(&mut console, line).await;
            run(&mut console, 5).await;
        }
        say(&mut console, "1 takeoff 20").await;
        run(&mut console, 1).await;
        let before = elapsed(&console);
        say(&mut console, "speedup 4").await;
        run(&mut console, 2).await;
        let passed = elapsed(&console).saturating_sub(before);
        assert!((7.0..9.0).contains(&passed.as_secs_f64()), "{passed:?}");
        assert_eq!(pace(&console), "4");
        // The takeoff takes 12 s.
        run(&mut console, 3).await;
        assert_eq!(pace(&console), "1");
        let said = said(&console).map(|it| it.to_string());
        assert_eq!(
            said.as_deref(),
            Some("back to real time: takeoff done, vehicle 1")
        );
        let before = elapsed(&console);
        run(&mut console, 4).await;
        let passed = elapsed(&console).saturating_sub(before);
        assert!((3.5..4.5).contains(&passed.as_secs_f64()), "{passed:?}");
    }

    #[tokio::test(start_paused = true)]
    async fn keys_make_time_pass_faster_as_far_as_the_mission_allows() {
        let mut console = Box::pin(reading()).await;
        run(&mut console, 5).await;
        console.feed(key(KeyCode::Enter)).await;
        console.feed(key(KeyCode::Char('>'))).await;
        assert_eq!(pace(&console), "1");
        assert_eq!(said(&console), Some(text!("speedup-nothing-to-wait-for")));
        for line in ["1 guided", "1 arm"] {
            say(&mut console, line).await;
            run(&mut console, 5).await;
        }
        say(&mut console, "1 takeoff 20").await;
        run(&mut console, 1).await;
        for expected in ["2", "4", "8", "8"] {
            console.feed(key(KeyCode::Char('>'))).await;
            assert_eq!(pace(&console), expected);
        }
        assert_eq!(said(&console), Some(text!("speedup-limit", most = "8")));
        console.feed(key(KeyCode::Char('<'))).await;
        assert_eq!(pace(&console), "1");
        say(&mut console, "speedup 20").await;
        assert_eq!(pace(&console), "1");
        assert_eq!(said(&console), Some(text!("speedup-too-much", most = "8")));
        say(&mut console, "speedup 0.5").await;
        assert_eq!(pace(&console), "1");
    }
}
