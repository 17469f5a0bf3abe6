//! Actions with the same effect in every room.

use super::ending::{guarded, leave, quit};
use super::selection;
use super::show::{brief, look_back, show};
use super::{class, mission, pace, palette, profiles, replay, sticks, vehicle_files};
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::Effects;
use crate::app::room::{self, RoomRequest, fly, standing};
use crate::app::state::{HelpPage, Log, Overlay};
use crate::text;
use crate::vehicle::Severity;

pub fn act(state: &mut State, action: Action) -> Effects {
    if let Some(reason) = state.action_refusal(action) {
        state.say(Severity::Notice, reason);
        return Effects::none();
    }
    if let Some(requests) = room::act(state, action) {
        return requested(state, requests);
    }
    match action {
        Action::Show(room) => show(state, room),
        Action::CommandLine => palette::write(state, ""),
        Action::Help => state.overlay = Some(Overlay::Help(HelpPage::default())),
        Action::Notices => look_back(state, Log::Notices),
        Action::Brief => brief(state),
        Action::Move(step) => fly::move_cursor(state, step),
        Action::Select(action) => selection::act(state, action),
        Action::Submit => selection::submit(state),
        Action::Escape => selection::cancel(state),
        Action::Again => return mission::restart(state, false),
        Action::AgainAlike => return mission::restart(state, true),
        Action::PauseMission => return mission::turn(state),
        Action::Faster => return pace::faster(state),
        Action::UsualPace => return pace::usual(state),
        Action::Replay(action) => return replay::act(state, action),
        Action::Abandon => return mission::abandon(state),
        Action::Leave => return leave(state),
        Action::Profiles => profiles::open(state),
        Action::Quit => return quit(state),
        Action::TakeSticks => sticks::open(state),
        Action::Acknowledge => fly::acknowledge_pressing(state),
        Action::Aids => {
            let requests = standing::change_aids(state);
            return requested(state, requests);
        }
        // Only prompts and some rooms handle these actions.
        Action::View(_)
        | Action::Line(_)
        | Action::Start(_)
        | Action::Debrief(_)
        | Action::Map(_)
        | Action::Ledger(_)
        | Action::Parameters(_)
        | Action::Files(_)
        | Action::Plans(_)
        | Action::Draw(_)
        | Action::Messages(_)
        | Action::Hangar(_)
        | Action::Class(_)
        | Action::Workshop(_) => {}
    }
    Effects::none()
}

fn requested(state: &mut State, requests: Vec<RoomRequest>) -> Effects {
    let mut effects = Effects::none();
    for request in requests {
        effects.extend(match request {
            RoomRequest::Effect(effect) => Effects::from(effect),
            RoomRequest::EndSession { question, effect } => guarded(state, question, effect),
            RoomRequest::Fly(launch) => mission::start(state, launch),
            RoomRequest::Exam(mission) => mission::start_exam(state, &mission),
            RoomRequest::Write(line) => {
                palette::write(state, &line);
                Effects::none()
            }
            RoomRequest::Give(line) => vehicle_files::give(state, &line),
            RoomRequest::Show(room) => {
                show(state, room);
                Effects::none()
            }
            RoomRequest::LookAway => {
                class::look_away(state, text!("class-shown-closed"));
                Effects::none()
            }
            RoomRequest::Leave => leave(state),
            RoomRequest::Quit => quit(state),
        });
    }
    effects
}
