//! The page on which a flight is graded.

use super::{ClassRoom, DeskPage};
use crate::app::action::Step;
use crate::app::effect::{ClassEffect, Effect};
use crate::grading::{FlightChoice, Grade, GradeSheet, GradedFlight, GradedRequest, RubricElement};
use crate::text;
use crate::text::Text;

/// A flight that is being graded.
#[derive(Debug, Clone)]
pub struct GradingPage {
    flight: GradedFlight,
    /// The element under the cursor, in the order of the rubric.
    cursor: usize,
}

impl GradingPage {
    /// Shows a flight; with the same rubric as before, the cursor stays on its element.
    pub(in crate::app) fn new(flight: GradedFlight, before: Option<&Self>) -> Self {
        let before = before.filter(|it| it.flight.rubric == flight.rubric);
        Self {
            cursor: before.map_or(0, |it| it.cursor),
            flight,
        }
    }

    /// The flight with its grades.
    pub fn flight(&self) -> &GradedFlight {
        &self.flight
    }

    /// The number of the element under the cursor, from 0.
    pub fn cursor(&self) -> usize {
        self.cursor
    }

    /// The element under the cursor; a rubric always has elements.
    pub fn element(&self) -> Option<&RubricElement> {
        self.flight.rubric.elements().nth(self.cursor)
    }

    /// The remark of the element under the cursor.
    pub(super) fn remark(&self) -> &str {
        let grade = self
            .element()
            .and_then(|it| self.flight.sheet.grades.get(&it.id));
        grade.map_or("", |it| it.text.as_str())
    }

    pub(in crate::app) fn sheet_mut(&mut self) -> &mut GradeSheet {
        &mut self.flight.sheet
    }

    /// The grade of the element under the cursor.
    ///
    /// # Errors
    /// It has none yet.
    pub(in crate::app) fn grade_mut(&mut self) -> Result<&mut Grade, Text> {
        let element = self.element().map(|it| it.id.clone());
        let grade = element.and_then(|id| self.flight.sheet.grade_mut(&id));
        grade.ok_or_else(|| text!("grading-rate-first"))
    }
}

impl ClassRoom {
    /// The flight that is being graded.
    pub fn grading(&self) -> Option<&GradingPage> {
        match self.page() {
            DeskPage::Grading(page) => Some(page),
            _ => None,
        }
    }

    pub(in crate::app) fn grading_mut(&mut self) -> Option<&mut GradingPage> {
        match &mut self.page {
            DeskPage::Grading(page) => Some(page),
            _ => None,
        }
    }

    /// Asks for a flight; until it comes, nothing is graded.
    pub(in crate::app) fn ask_graded(&mut self, request: GradedRequest) -> Effect {
        self.awaited = Some(request.clone());
        Effect::Class(ClassEffect::ReadGraded(request))
    }

    /// Moves to another element, or asks for an older or newer flight of the trainee.
    pub(super) fn move_in_grading(&mut self, step: Step) -> Option<Effect> {
        let page = self.grading_mut()?;
        let flight = &page.flight;
        let record = flight.record.clone();
        let choice = match step {
            Step::Left => FlightChoice::Older(record),
            Step::Right => FlightChoice::Newer(record),
            _ => {
                page.cursor = step.apply(page.cursor, flight.rubric.elements().count());
                return None;
            }
        };
        let request = GradedRequest {
            user: flight.user.clone(),
            choice,
            rubric: Some(flight.rubric.name.clone()),
        };
        Some(self.ask_graded(request))
    }
}
