//! Carries out what events cause outside the state.

use super::Console;
use super::begin::parse;
use super::session::Plan;
use crate::app::effect::Effect;
use crate::app::event::Event;
use crate::app::update;
use crate::notice::sanitised;
use crate::session::Order;
use crate::terminal::Environment;
use crate::text::Text;

impl Console {
    /// Takes something in, and carries out what comes of it.
    pub(super) async fn feed(&mut self, event: Event) {
        for effect in update(&mut self.state, event) {
            self.carry_out(effect).await;
        }
        self.keep_line();
    }

    async fn carry_out(&mut self, effect: Effect) {
        let plan = match effect {
            Effect::Quit => return self.over = true,
            Effect::Bell => return self.bell = true,
            Effect::Notify(text) => {
                return self.note = Some(sanitised(&self.look.locale.text(&text)));
            }
            Effect::LeaveSession => return self.end_session(),
            Effect::SetTheme(name) => return self.set_theme(&name),
            Effect::SetFps(fps) => return self.fps = Some(fps),
            Effect::FetchParameters(_)
            | Effect::ReadParameters { .. }
            | Effect::SaveParameters { .. }
            | Effect::ReadDesign { .. }
            | Effect::WriteDesign { .. } => return self.files(effect),
            Effect::AbandonMission => return self.abandon(),
            Effect::Inject(name) => return self.inject(&name),
            Effect::Pause => return self.pause(),
            Effect::GoOn => return self.go_on(),
            Effect::Command {
                entry,
                targets,
                verb,
                command,
            } => {
                let order = Order::new(entry, verb, command);
                return self.command(&targets, &order).await;
            }
            Effect::Deed {
                entry,
                targets,
                deed,
            } => return self.deed(entry, &targets, &deed).await,
            Effect::Manoeuvre {
                entry,
                targets,
                manoeuvre,
            } => return self.begin_manoeuvre(entry, &manoeuvre, &targets).await,
            Effect::ChooseProfile(_)
            | Effect::CreateProfile(_)
            | Effect::LeaveProfile
            | Effect::SetAids(_)
            | Effect::BuyPart(_)
            | Effect::KeepDesign(_)
            | Effect::RenameDesign { .. }
            | Effect::SetLanguage(_)
            | Effect::DropDesign(_) => return self.change_career(effect),
            Effect::StartMission(launch) => {
                let outcome = self.start_mission(&launch).await;
                return self.tell_failure(outcome);
            }
            Effect::StartFree => Ok(Plan::Free(None)),
            Effect::StartArduPilot => Ok(Plan::Free(self.options.ardupilot.clone())),
            Effect::Hangar(deed, vehicle) => {
                return self
                    .running
                    .iter()
                    .for_each(|running| running.process(deed, vehicle));
            }
            Effect::Connect(addresses) => parse(&addresses).map(Plan::Connect),
            Effect::RestartMission { alike } => match &self.running {
                Some(running) => {
                    let plan = running.plan();
                    return self.start_again(plan, alike).await;
                }
                None => return,
            },
        };
        let outcome = match plan {
            Ok(plan) => self.start_afresh(plan).await,
            Err(error) => Err(error),
        };
        self.tell_failure(outcome);
    }

    /// Says why something was not to be had.
    pub(super) fn tell_failure(&mut self, outcome: Result<(), Text>) {
        if let Err(error) = outcome {
            // Nothing that a failure causes is an effect.
            update(&mut self.state, Event::Failed(error));
        }
    }

    fn set_theme(&mut self, name: &str) {
        match self.options.preferences.themes.named(name) {
            Ok(theme) => {
                self.look.theme = theme.for_colours(Environment::of_process().colour_depth());
            }
            // Nothing that a failure causes is an effect.
            Err(error) => drop(update(&mut self.state, Event::Failed(Text::from(&error)))),
        }
    }
}
