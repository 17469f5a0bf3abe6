//! Carries out effects and handles the resulting events.

use super::Console;
use super::begin::parse;
use super::session::SessionPlan;
use crate::app::effect::{Effect, ForwardChange, SessionEffect, TerminalEffect};
use crate::app::event::Event;
use crate::notice::sanitised;
use crate::terminal::Environment;
use crate::text::Text;

impl Console {
    /// Handles an event, and all queued events.
    pub(super) async fn feed(&mut self, event: impl Into<Event>) {
        self.post(event);
        self.take_in().await;
    }

    /// Queues an event. Events that arise while an effect is carried out are handled like any other.
    pub(super) fn post(&mut self, event: impl Into<Event>) {
        self.inbox.push_back(event.into());
    }

    /// Handles the queued events and their effects until none is left.
    pub(super) async fn take_in(&mut self) {
        while let Some(event) = self.inbox.pop_front() {
            if let Some(running) = &self.running {
                running.note_event(self.clock.now(), &event);
            }
            for effect in self.app.update(event) {
                self.carry_out(effect).await;
            }
        }
        self.keep_line();
    }

    async fn carry_out(&mut self, effect: Effect) {
        match effect {
            Effect::Quit => self.over = true,
            Effect::Order { entry, order } => self.order(entry, &order),
            Effect::AnswerProgram(answer) => self.program_answer = Some(answer),
            Effect::FetchParameters(vehicles) => {
                if let Some(running) = &self.running {
                    running.fetch_parameters(&vehicles);
                }
            }
            Effect::File(effect) => self.handle_file(effect),
            Effect::TryDrafts(trial) => self.begin_trial(trial),
            Effect::Career(change) => self.change_career(change),
            Effect::Class(effect) => self.serve_class(effect),
            Effect::Crew(effect) => self.serve_crew(effect),
            Effect::Session(effect) => self.steer(effect).await,
            Effect::Replay(effect) => self.steer_replay(effect),
            Effect::Terminal(effect) => self.adjust(effect),
        }
    }

    async fn steer(&mut self, effect: SessionEffect) {
        let outcome = match effect {
            SessionEffect::StartMission(launch) => self.start_mission(&launch).await,
            SessionEffect::StartFree => self.start_afresh(SessionPlan::Free(None)).await,
            SessionEffect::StartArduPilot => {
                let plan = SessionPlan::Free(self.options.ardupilot.clone());
                self.start_afresh(plan).await
            }
            SessionEffect::Connect(addresses) => match parse(&addresses) {
                Ok(addresses) => self.start_afresh(SessionPlan::Connect(addresses)).await,
                Err(error) => Err(error),
            },
            SessionEffect::Replay { path, review } => self.replay(path.as_deref(), review),
            SessionEffect::Bookmark(text) => {
                self.bookmark(text);
                Ok(())
            }
            SessionEffect::Ghost(source) => self.fetch_ghost(source),
            SessionEffect::Restart { alike } => self.start_again(alike).await,
            SessionEffect::Forget(vehicles) => {
                if let Some(running) = &mut self.running {
                    running.forget(&vehicles);
                }
                Ok(())
            }
            SessionEffect::Radio { vehicles, test } => {
                if let Some(running) = &self.running {
                    running.test_radio(&vehicles, test);
                }
                Ok(())
            }
            SessionEffect::Sticks { vehicle, held } => {
                if let Some(running) = &self.running {
                    running.steer_by_hand(vehicle, held);
                }
                Ok(())
            }
            SessionEffect::Forward(change) => self.change_forwards(change),
            SessionEffect::Process(deed, vehicle) => {
                if let Some(running) = &self.running {
                    running.process(deed, vehicle);
                }
                Ok(())
            }
            SessionEffect::Inject(name) => {
                self.inject(&name);
                Ok(())
            }
            SessionEffect::Pause => {
                self.pause();
                Ok(())
            }
            SessionEffect::Continue => {
                self.go_on();
                Ok(())
            }
            SessionEffect::Speedup(change) => {
                self.set_speedup(change);
                Ok(())
            }
            SessionEffect::Situation(work) => {
                self.begin_situation(work);
                Ok(())
            }
            SessionEffect::Abandon => {
                self.abandon();
                Ok(())
            }
            SessionEffect::Stop => {
                self.stop();
                Ok(())
            }
            SessionEffect::Leave => {
                self.release_sticks().await;
                self.end_session();
                Ok(())
            }
        };
        self.tell_failure(outcome);
    }

    /// Opens or closes a forward, also for later sessions of this console.
    fn change_forwards(&mut self, change: ForwardChange) -> Result<(), Text> {
        if let Some(running) = &self.running {
            running.change_forwards(&change)?;
        }
        let forwards = &mut self.options.forwards;
        match change {
            ForwardChange::Open(spec) => forwards.push(spec),
            ForwardChange::Close(address) => forwards.retain(|spec| spec.address != address),
        }
        Ok(())
    }

    fn adjust(&mut self, effect: TerminalEffect) {
        match effect {
            TerminalEffect::SetTheme(name) => self.set_theme(&name),
            TerminalEffect::SetFps(fps) => self.sight.fps = Some(fps),
            TerminalEffect::Bell => self.sight.bell = true,
            TerminalEffect::Notify(text) => {
                self.sight
                    .notes
                    .push(sanitised(&self.sight.look.locale.text(&text)));
            }
        }
    }

    /// Shows why an effect failed.
    pub(super) fn tell_failure(&mut self, outcome: Result<(), Text>) {
        if let Err(error) = outcome {
            self.post(Event::Failed(error));
        }
    }

    fn set_theme(&mut self, name: &str) {
        match self.options.preferences.themes.named(name) {
            Ok(theme) => {
                self.sight.look.theme = theme.for_colours(Environment::of_process().colour_depth());
            }
            Err(error) => self.post(Event::Failed(Text::from(&error))),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use super::*;
    use crate::notice::{Notice, NoticeSource};
    use crate::shell::{ConsoleOptions, Opening};
    use crate::vehicle::Severity;

    fn console() -> Console {
        let options = ConsoleOptions::for_test(Opening::Home);
        Console::new(options, true)
    }

    #[tokio::test]
    async fn what_happens_while_an_effect_is_carried_out_rings_and_is_noticed() {
        let mut console = console();
        console.post(Notice {
            source: NoticeSource::Vehicle,
            ..Notice::about(
                1,
                Duration::ZERO,
                Severity::Emergency,
                "Crash: Disarming".into(),
            )
        });
        console.adjust(TerminalEffect::SetTheme("none of that name".to_owned()));
        assert!(!console.sight.bell, "nothing is taken in meanwhile");
        console.take_in().await;
        assert!(console.sight.bell);
        assert_eq!(console.app.state().notices().lines().len(), 2);
    }

    #[test]
    fn notifications_wait_for_a_frame_without_replacing_each_other() {
        let mut console = console();
        console.adjust(TerminalEffect::Notify("one".into()));
        console.adjust(TerminalEffect::Notify("two".into()));
        assert_eq!(console.sight.notes, ["one", "two"]);
    }
}
