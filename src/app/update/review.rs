//! The pilot's review of the replay.

use std::time::Duration;

use super::replay;
use super::show::show;
use crate::app::State;
use crate::app::effect::{Effect, Effects, FileEffect, FileKind};
use crate::app::room::Room;
use crate::app::room::review::{ReviewPage, moments};
use crate::language::ReviewLine;
use crate::review::{PointKind, ReviewedFlight, markdown};
use crate::text;
use crate::text::{Text, utc_of};
use crate::vehicle::Severity;

/// Carries out a command about the review.
///
/// # Errors
/// There is no replay, or the command does not fit the review's state.
pub fn carry_out(state: &mut State, line: ReviewLine) -> Result<Effects, Text> {
    if line == ReviewLine::Open {
        return Ok(open(state));
    }
    let at = pointed(state);
    let view = state
        .replay
        .as_mut()
        .ok_or_else(|| text!("review-none-open"))?;
    let review = &mut view.review;
    match line {
        ReviewLine::Open => {}
        ReviewLine::Why(text) => review.why = text,
        ReviewLine::Next(text) => review.next = text,
        ReviewLine::Sustain(text) => review.add(PointKind::Sustain, at, text)?,
        ReviewLine::Improve(text) => review.add(PointKind::Improve, at, text)?,
        ReviewLine::Remove(number) => review.remove(number)?,
        ReviewLine::Export(path) => return Ok(export(state, path)),
    }
    let kept = replay::keep(view);
    state.say(Severity::Notice, text!("review-kept"));
    Ok(kept)
}

/// Shows the review of the replay; without a replay, the review of the newest record.
fn open(state: &mut State) -> Effects {
    if state.replay.is_none() {
        return replay::open(state, None, true);
    }
    show(state, Room::Review);
    Effects::none()
}

/// The time to which a review's point refers: the moment under the cursor if moments are shown,
/// otherwise the replay's position.
fn pointed(state: &State) -> Duration {
    let room = &state.rooms.review;
    let chosen = match room.page {
        ReviewPage::Happened if state.room == Room::Review => {
            let moments = moments(state);
            moments.get(room.cursor).or(moments.last()).map(|it| it.at)
        }
        ReviewPage::Planned
        | ReviewPage::Happened
        | ReviewPage::Why
        | ReviewPage::Next
        | ReviewPage::Explained
        | ReviewPage::Compared => None,
    };
    let view = state.replay.as_ref();
    chosen
        .or_else(|| view.map(|it| it.position.at))
        .unwrap_or_default()
}

/// Writes the review to a file as a document.
fn export(state: &State, path: String) -> Effects {
    let Some(view) = &state.replay else {
        return Effects::none();
    };
    let title = match &state.session.task.listing {
        Some(mission) => state.locale.text(&mission.title),
        None => view.name.clone(),
    };
    let flight = ReviewedFlight {
        title: &title,
        began: &utc_of(view.began_unix_us),
        brief: state.session.task.listing.as_ref().map(|it| &it.brief),
        report: view.report.as_deref(),
        moments: &view.moments,
        clock: &view.clock,
    };
    Effects::from(Effect::File(FileEffect::Write {
        kind: FileKind::Review,
        path,
        text: markdown(&view.review, flight, &state.locale),
        replace: false,
    }))
}
