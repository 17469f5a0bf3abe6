//! Grades of flights at the desk.

use super::super::show::show;
use super::tell;
use crate::app::State;
use crate::app::effect::{ClassEffect, Effect, Effects};
use crate::app::room::class::{DeskPage, GradingPage, show_page};
use crate::app::state::Room;
use crate::grading::{FlightChoice, GradedFlight, GradedRequest, Mark};
use crate::language::{GradingLine, Rating};
use crate::text;
use crate::text::Text;
use crate::vehicle::Severity;

/// Carries out a line about grades.
///
/// # Errors
/// This console is no desk, no trainee is meant, or no flight is being graded.
pub(super) fn carry_out(state: &mut State, line: GradingLine) -> Result<Effects, Text> {
    match line {
        GradingLine::Open { trainee, rubric } => open(state, trainee, rubric),
        GradingLine::Rate(rating) => {
            let page = page(state)?;
            let element = page.element().map_or_else(String::new, |it| it.id.clone());
            let sheet = page.sheet_mut();
            match rating {
                Rating::Mark(number) => {
                    let mark = Mark::try_from(number);
                    let mark = mark.map_err(|_| text!("grading-rate-first"))?;
                    sheet.rate(&element, Some(mark));
                }
                Rating::NotObserved => sheet.rate(&element, None),
                Rating::Clear => sheet.clear(&element),
            }
            Ok(keep(page))
        }
        GradingLine::Remark(text) => {
            let page = page(state)?;
            page.grade_mut()?.text = text;
            Ok(keep(page))
        }
        GradingLine::Cite(number) => {
            let page = page(state)?;
            let bookmarks = &page.flight().bookmarks;
            let count = bookmarks.len();
            let bookmark = number.checked_sub(1).and_then(|it| bookmarks.get(it));
            let recorded = bookmark.map(|it| it.recorded);
            let recorded = recorded.ok_or_else(|| text!("grading-no-bookmark", count = count))?;
            page.grade_mut()?.cite(recorded);
            Ok(keep(page))
        }
    }
}

/// Asks for the newest flight of a trainee.
fn open(
    state: &mut State,
    trainee: Option<String>,
    rubric: Option<String>,
) -> Result<Effects, Text> {
    let user = trainee.or_else(|| under_cursor(state));
    state.class.desk().ok_or_else(|| text!("class-no-desk"))?;
    let user = user.ok_or_else(|| text!("grading-no-trainee"))?;
    show(state, Room::Class);
    if !matches!(state.rooms.class.page(), DeskPage::Grading(_)) {
        show_page(state, DeskPage::Board);
    }
    let room = &mut state.rooms.class;
    let request = GradedRequest {
        user,
        choice: FlightChoice::Newest,
        rubric: rubric.or_else(|| room.rubric.clone()),
    };
    Ok(room.ask_graded(request).into())
}

/// The trainee at the seat under the cursor.
fn under_cursor(state: &State) -> Option<String> {
    let seat = state.rooms.class.cursor()?;
    let seat = state.class.desk()?.seats().get(seat)?;
    Some(seat.user().to_owned())
}

/// The flight that is being graded.
///
/// # Errors
/// There is none, or another one was asked for and has not come yet.
fn page(state: &mut State) -> Result<&mut GradingPage, Text> {
    let room = &mut state.rooms.class;
    if room.awaited.is_some() {
        return Err(text!("grading-reading"));
    }
    room.grading_mut().ok_or_else(|| text!("grading-none"))
}

fn keep(page: &GradingPage) -> Effects {
    let flight = page.flight();
    Effects::from(Effect::Class(ClassEffect::KeepGrades {
        user: flight.user.clone(),
        record: flight.record.clone(),
        sheet: flight.sheet.clone(),
    }))
}

/// The grades of so many flights are not written yet, with the reason; none of them wait any more without one.
pub(super) fn wait(state: &mut State, count: usize, fault: Option<Text>) {
    state.rooms.class.unwritten_grades = count;
    match fault {
        Some(fault) => {
            let text = text!("grading-waits", count = count, fault = fault);
            tell(state, Severity::Warning, text);
        }
        None => tell(state, Severity::Notice, text!("grading-written")),
    }
}

/// Shows the flight that was asked for last, or why it cannot be graded.
pub(super) fn read(
    state: &mut State,
    asked: &GradedRequest,
    flight: Result<Box<GradedFlight>, Text>,
) {
    let room = &mut state.rooms.class;
    if room.awaited.take_if(|it| it == asked).is_none() {
        return;
    }
    match flight {
        Ok(flight) => {
            let skipped = flight.skipped.first().cloned();
            room.rubric.clone_from(&asked.rubric);
            let page = GradingPage::new(*flight, room.grading());
            show_page(state, DeskPage::Grading(Box::new(page)));
            if let Some(fault) = skipped {
                state.say(Severity::Warning, fault);
            }
        }
        Err(fault) => state.say(Severity::Warning, fault),
    }
}
