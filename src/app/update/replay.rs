//! The course of a replay, and its control.

use super::show::{look_back, show};
use super::{ending, start, telemetry};
use crate::app::action::ReplayAction;
use crate::app::effect::{Effect, Effects, ReplayEffect, SessionEffect};
use crate::app::event::ReplayEvent;
use crate::app::state::{Log, ReplayView, Room, rate};
use crate::app::{State, snapshot};
use crate::language::{ReplayLine, SeekTarget};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;
use std::time::Duration;

/// How far a key press jumps.
const KEY_STEP: Duration = Duration::from_secs(10);
/// The rates that the keys set, from the lowest to the highest rate of a replay.
const RATES: [f64; 10] = [0.1, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0];
const SLOWEST: f64 = RATES[0];
const FASTEST: f64 = RATES[RATES.len() - 1];

/// Handles an event of a replay.
pub fn happened(state: &mut State, event: ReplayEvent) {
    match event {
        ReplayEvent::Opened { view, started } => start::opened(state, *view, *started),
        ReplayEvent::Known {
            length,
            moments,
            report,
        } => {
            if let Some(view) = &mut state.replay {
                (view.length, view.moments, view.report) = (length, moments, report);
            }
        }
        ReplayEvent::Gaps(gaps) => {
            if let Some(view) = &mut state.replay {
                view.gaps = gaps;
            }
        }
        ReplayEvent::Restored(flight) => snapshot::restore(state, *flight),
        ReplayEvent::At(position) => {
            telemetry::pass(state, position.at);
            if let Some(view) = &mut state.replay
                && view.position != position
            {
                view.position = position;
                state.touch();
            }
            return;
        }
    }
    state.touch();
}

/// Carries out an action.
pub fn act(state: &mut State, action: ReplayAction) -> Effects {
    let replay = state.replay.as_ref();
    let is_playing = replay.is_some_and(|it| it.position.is_playing);
    let effect = match action {
        // In a replay, both actions mean the flight that is shown.
        ReplayAction::ReplayNewest if replay.is_some() => {
            show(state, Room::Fly);
            ReplayEffect::Seek(SeekTarget::At(Duration::ZERO))
        }
        ReplayAction::ReviewNewest if replay.is_some() => {
            show(state, Room::Review);
            return Effects::none();
        }
        ReplayAction::ReplayNewest => return open(state, None, false),
        ReplayAction::ReviewNewest => return open(state, None, true),
        ReplayAction::ShowMoments if replay.is_some() => {
            look_back(state, Log::Moments);
            return Effects::none();
        }
        ReplayAction::ShowMoments => return refuse(state),
        ReplayAction::PlayReplay => ReplayEffect::Play(!is_playing),
        ReplayAction::Rewind => ReplayEffect::Rewind,
        ReplayAction::ReplayBack => ReplayEffect::Seek(SeekTarget::Earlier(KEY_STEP)),
        ReplayAction::ReplayForward => ReplayEffect::Seek(SeekTarget::Later(KEY_STEP)),
        ReplayAction::FrameBack => ReplayEffect::Step { forward: false },
        ReplayAction::FrameForward => ReplayEffect::Step { forward: true },
        ReplayAction::PreviousMoment => ReplayEffect::Moment { forward: false },
        ReplayAction::NextMoment => ReplayEffect::Moment { forward: true },
    };
    if state.replay.is_none() {
        return refuse(state);
    }
    Effects::from(Effect::Replay(effect))
}

/// Replays a file, or the newest record; asks first if something would be lost.
pub fn open(state: &mut State, path: Option<String>, review: bool) -> Effects {
    let question = if review {
        text!("ask-review")
    } else {
        text!("ask-replay")
    };
    let effect = Effect::Session(SessionEffect::Replay { path, review });
    ending::guarded(state, question, effect)
}

/// Goes to the moment with this index in the list; `None` for the last.
pub fn go_to(state: &State, moment: Option<usize>) -> Effects {
    let moments = state.replay.iter().flat_map(|it| it.moments.iter());
    let chosen = match moment {
        Some(at) => moments.clone().nth(at),
        None => moments.last(),
    };
    let Some(moment) = chosen else {
        return Effects::none();
    };
    Effects::from(Effect::Replay(ReplayEffect::Show(moment.at)))
}

/// Carries out a command about the replay.
pub fn carry_out(state: &mut State, line: ReplayLine) -> Effects {
    let effect = match line {
        ReplayLine::Open(path) => return open(state, path, false),
        ReplayLine::Seek(target) => ReplayEffect::Seek(target),
        ReplayLine::Loop(stretch) => ReplayEffect::Loop(stretch),
        ReplayLine::StopAt(kinds) => ReplayEffect::StopAt(kinds),
        ReplayLine::Rewind => ReplayEffect::Rewind,
    };
    if state.replay.is_none() {
        return refuse(state);
    }
    if let Some(text) = confirmation(&effect) {
        state.say(Severity::Notice, text);
    }
    Effects::from(Effect::Replay(effect))
}

/// The confirmation of a control whose effect is not visible at once.
fn confirmation(effect: &ReplayEffect) -> Option<Text> {
    match effect {
        ReplayEffect::StopAt(kinds) if kinds.is_empty() => Some(text!("stopat-off")),
        ReplayEffect::StopAt(kinds) => {
            let kinds = kinds.iter().map(|kind| kind.text()).collect();
            Some(text!("stopat-on", kinds = Text::joined(", ", kinds)))
        }
        ReplayEffect::Loop(None) => Some(text!("loop-off")),
        ReplayEffect::Loop(Some(_))
        | ReplayEffect::Play(_)
        | ReplayEffect::Rewind
        | ReplayEffect::Rate(_)
        | ReplayEffect::Seek(_)
        | ReplayEffect::Step { .. }
        | ReplayEffect::Moment { .. }
        | ReplayEffect::Show(_)
        | ReplayEffect::Keep(_) => None,
    }
}

pub fn play(plays: bool) -> Effects {
    Effects::from(Effect::Replay(ReplayEffect::Play(plays)))
}

/// Sets the rate, within the limits.
pub fn set_rate(state: &mut State, wanted: f64) -> Effects {
    let possible = wanted.clamp(SLOWEST, FASTEST);
    let text = if (SLOWEST..=FASTEST).contains(&wanted) {
        text!("replay-rate", rate = rate(possible))
    } else {
        text!(
            "replay-rate-limit",
            rate = rate(possible),
            slowest = rate(SLOWEST),
            fastest = rate(FASTEST)
        )
    };
    state.say(Severity::Notice, text);
    Effects::from(Effect::Replay(ReplayEffect::Rate(possible)))
}

/// Changes the rate with a key, to the next one in the table.
pub fn change_rate(state: &mut State, faster: bool) -> Effects {
    let now = state.replay.as_ref().map_or(1.0, |it| it.position.rate);
    let next = if faster {
        RATES.into_iter().find(|rate| *rate > now)
    } else {
        RATES.into_iter().rfind(|rate| *rate < now)
    };
    set_rate(state, next.unwrap_or(now))
}

/// Sets a bookmark at the current time. In a replay it is stored beside the record; an existing
/// bookmark gets the new text.
///
/// # Errors
/// There is no flight or replay, or there are too many bookmarks.
pub fn bookmark(state: &mut State, text: String) -> Result<Effects, Text> {
    let Some(view) = &mut state.replay else {
        if state.session.activity.is_none() {
            return Err(text!("bookmark-nothing"));
        }
        let effect = SessionEffect::Bookmark(text);
        return Ok(Effects::from(Effect::Session(effect)));
    };
    let known = view.bookmark_here();
    let here = known.unwrap_or(view.position.at);
    view.review.set_bookmark(&view.bookmarks(), here, text)?;
    let kept = keep(view);
    let done = match known {
        Some(_) => text!("bookmark-renamed"),
        None => text!("bookmark-set"),
    };
    state.say(Severity::Notice, done);
    Ok(kept)
}

/// Removes the bookmark on the current frame.
///
/// # Errors
/// There is no bookmark here, or nothing is being replayed.
pub fn unbookmark(state: &mut State) -> Result<Effects, Text> {
    let view = state.replay.as_mut().ok_or_else(|| text!("replay-none"))?;
    let here = view.bookmark_here().ok_or_else(|| text!("bookmark-none"))?;
    view.review.remove_bookmark(&view.bookmarks(), here);
    let kept = keep(view);
    state.say(Severity::Notice, text!("bookmark-removed"));
    Ok(kept)
}

/// Stores the user's review of a replay.
pub fn keep(view: &mut ReplayView) -> Effects {
    view.take_bookmarks();
    let review = Box::new(view.review.clone());
    Effects::from(Effect::Replay(ReplayEffect::Keep(review)))
}

fn refuse(state: &mut State) -> Effects {
    state.say(Severity::Warning, text!("replay-none"));
    Effects::none()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::Setup;
    use crate::app::action::Action;
    use crate::app::update::act as actions;

    #[test]
    fn a_replay_is_reviewed_and_played_again_itself() {
        let mut state = State::new(Setup::default());
        let newest = act(&mut state, ReplayAction::ReviewNewest);
        let open = SessionEffect::Replay {
            path: None,
            review: true,
        };
        assert_eq!(newest, Effects::from(Effect::Session(open)));
        state.replay = Some(ReplayView::new("a".to_owned(), 0, Duration::from_secs(60)));
        assert_eq!(act(&mut state, ReplayAction::ReviewNewest), Effects::none());
        assert_eq!(state.room(), Room::Review);
        let again = act(&mut state, ReplayAction::ReplayNewest);
        let start = ReplayEffect::Seek(SeekTarget::At(Duration::ZERO));
        assert_eq!(again, Effects::from(Effect::Replay(start)));
        assert_eq!(state.room(), Room::Fly);
    }

    #[test]
    fn escape_in_the_debrief_of_a_replay_leads_back_to_the_flight() {
        let mut state = State::new(Setup::default());
        state.replay = Some(ReplayView::new("a".to_owned(), 0, Duration::from_secs(60)));
        show(&mut state, Room::Debrief);
        let done = actions::act(&mut state, Action::Escape);
        assert_eq!(done, Effects::none());
        assert_eq!(state.room(), Room::Fly);
        assert!(state.replay.is_some(), "the replay is still open");
    }

    #[test]
    fn a_bookmark_that_is_there_is_renamed() {
        let mut state = State::new(Setup::default());
        state.replay = Some(ReplayView::new("a".to_owned(), 0, Duration::from_secs(60)));
        for said in [text!("bookmark-set"), text!("bookmark-renamed")] {
            let kept = bookmark(&mut state, "here".to_owned());
            assert!(kept.is_ok(), "{kept:?}");
            assert_eq!(state.message().map(|it| &it.text), Some(&said));
        }
    }

    #[test]
    fn a_rate_beyond_the_limits_is_told_with_them() {
        let mut state = State::new(Setup::default());
        let set = set_rate(&mut state, 500.0);
        let effect = Effect::Replay(ReplayEffect::Rate(FASTEST));
        assert_eq!(set, Effects::from(effect));
        let said = state.message().map(|it| it.text.to_string());
        assert!(said.is_some_and(|it| it.contains("0.1 to 64")));
    }
}
