//! Lines from programs: carried out like the user's, without disturbing the user's input and open
//! questions.

use super::order::{self, Given};
use super::{consequence, console_line, own_fence};
use crate::app::State;
use crate::app::effect::{Effect, Effects, ProgramAnswer, ProgramFault};
use crate::app::event::ProgramLine;
use crate::app::state::{Activity, Overlay};
use crate::diagnostic::Diagnostic;
use crate::language::{self, ConsoleLine, Scope};
use crate::ledger::EntryId;
use crate::mission::Stake;
use crate::operator::first_word;
use crate::text;
use crate::verb::Danger;

/// Carries out a program's line, and sends the answer.
pub fn give(state: &mut State, said: &ProgramLine) -> Effects {
    // A question to the user stays open; a question that the line raises is not put to the user.
    let overlay = state.overlay.take();
    let message = state.message().cloned();
    let outcome = carry_out(state, said);
    let news = state.message().filter(|it| Some(*it) != message.as_ref());
    let text = news.map(|it| it.text.clone());
    state.overlay = overlay;
    match outcome {
        Ok((entry, mut effects)) => {
            let answer = ProgramAnswer { entry, text };
            effects.extend([Effect::AnswerProgram(Ok(answer))]);
            effects
        }
        Err(fault) => Effects::from(Effect::AnswerProgram(Err(fault))),
    }
}

fn carry_out(
    state: &mut State,
    said: &ProgramLine,
) -> Result<(Option<EntryId>, Effects), ProgramFault> {
    let line = said.line.as_str();
    permit(state, line)?;
    match order::read_for(state, line, None, &[])? {
        Given::Order(order) => {
            let hazard = own_fence::hazard(state, &order);
            if order.verb.danger == Danger::Confirm || hazard.is_some() {
                let reason = hazard.unwrap_or_else(|| text!("api-asks"));
                asks(said, Diagnostic::new(first_word(line), reason))?;
            }
            let sent = order::send(state, order);
            Ok((Some(sent.entry), Effects::from(sent.effect)))
        }
        Given::Own(ConsoleLine::Macro(_)) => {
            let fault = Diagnostic::new(first_word(line), text!("api-no-macro"));
            Err(fault.into())
        }
        Given::Own(own) => {
            let effects = console_line::carry_out(state, line, own)?;
            let Some(Overlay::Confirm(question)) = state.overlay.take() else {
                return Ok((None, effects));
            };
            let fault = Diagnostic::new(first_word(line), question.question().clone());
            asks(said, fault.with_help(question.reason().clone()))?;
            Ok((None, consequence::carry_out(state, question.then)))
        }
    }
}

/// Refuses lines that programs may never give, or may not give now.
fn permit(state: &State, line: &str) -> Result<(), ProgramFault> {
    let is_exam = matches!(
        state.session.activity,
        Some(Activity::Mission {
            stake: Stake::Exam,
            ..
        })
    );
    let row = state.with_context(|context| language::said(line, context))?;
    let text = match row.scope {
        _ if is_exam => text!("api-exam"),
        Scope::Screen | Scope::Plain => text!("api-screen"),
        Scope::Everywhere | Scope::Scripts | Scope::Console => return Ok(()),
    };
    Err(Diagnostic::new(first_word(line), text).into())
}

/// Refuses a dangerous line that the program has not confirmed.
fn asks(said: &ProgramLine, fault: Diagnostic) -> Result<(), ProgramFault> {
    if said.confirmed {
        return Ok(());
    }
    Err(ProgramFault { fault, asks: true })
}

impl From<Diagnostic> for ProgramFault {
    fn from(fault: Diagnostic) -> Self {
        Self { fault, asks: false }
    }
}
