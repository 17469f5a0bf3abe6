//! Another flight of the mission, shown beside the current one.

use crate::app::State;
use crate::app::effect::{Effect, Effects, SessionEffect};
use crate::app::state::{Activity, Ghost};
use crate::language::{GhostLine, GhostSource};
use crate::mission::Stake;
use crate::moment::Alignment;
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Carries out a command about the other flight.
///
/// # Errors
/// There is no mission, no other flight is shown, a comparison is not allowed now, or the aligning
/// event is missing in one of the flights.
pub fn carry_out(state: &mut State, line: GhostLine) -> Result<Effects, Text> {
    match line {
        GhostLine::Show(source) => {
            admit(state, &source)?;
            state.say(Severity::Notice, text!("ghost-fetching"));
            return Ok(Effects::from(Effect::Session(SessionEffect::Ghost(source))));
        }
        GhostLine::AlignedBy(alignment) => {
            let ghost = state.ghost.as_mut().ok_or_else(|| text!("ghost-none"))?;
            if !ghost.align(alignment) {
                return Err(not_aligned(ghost, alignment));
            }
            state.say(
                Severity::Notice,
                text!("ghost-aligned", moment = alignment.text()),
            );
        }
        GhostLine::Off => {
            state.ghost.take().ok_or_else(|| text!("ghost-none"))?;
            state.say(Severity::Notice, text!("ghost-off"));
        }
    }
    Ok(Effects::none())
}

fn not_aligned(ghost: &Ghost, alignment: Alignment) -> Text {
    let own = ghost.own.as_ref();
    match own.filter(|_| alignment == Alignment::Bookmark) {
        Some(own) if own.bookmarks.is_empty() => text!("ghost-no-bookmark"),
        Some(_) => text!(
            "ghost-no-bookmark-in-other",
            name = ghost.other.name.clone()
        ),
        None => text!("ghost-not-in-both", moment = alignment.text()),
    }
}

/// Refuses a flight that may not be shown beside this one. In an exam, none may be shown. In a
/// flight that counts, only the trainee's own best one may, because another pilot's flight would
/// give the solution away.
fn admit(state: &State, source: &GhostSource) -> Result<(), Text> {
    let Some(Activity::Mission { stake, .. }) = &state.session.activity else {
        return Err(text!("ghost-no-mission"));
    };
    if state.replay.is_some() {
        return Ok(());
    }
    match (stake, source) {
        (Stake::Exam, _) => Err(text!("ghost-in-exam")),
        (Stake::Practice, _) | (Stake::Graded | Stake::Daily, GhostSource::Best) => Ok(()),
        (Stake::Graded | Stake::Daily, GhostSource::Reference | GhostSource::File(_)) => {
            Err(text!("ghost-practice-only"))
        }
    }
}

/// Shows the other flight.
pub fn arrived(state: &mut State, ghost: Ghost) {
    let report = &ghost.other.report;
    let text = text!(
        "ghost-shown",
        name = ghost.other.name.clone(),
        score = report.score,
        seed = report.seed.to_string()
    );
    state.ghost = Some(ghost);
    state.say(Severity::Notice, text);
    state.touch();
}
