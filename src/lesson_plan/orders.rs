//! Reads the orders of a step.

use std::ops::Range;

use toml::Spanned;

use super::written::WrittenStep;
use super::{Findings, LessonSetting};
use crate::class::Deed;
use crate::diagnostic::Diagnostic;
use crate::language::{
    self, Channel, ClassLine, ConsoleLine, Context, Meaning, SeatChoice, mission_meant,
};
use crate::mission::{Mission, check_condition};
use crate::text;
use crate::text::Text;

/// The verb of the desk, which the lines of a step leave out.
const VERB: &str = "class ";
/// The maximum number of characters in a message: it is sent to the seats.
const LONGEST_MESSAGE: usize = 200;

/// The flight at a place in the file: that of the last `fly` before it.
#[derive(Debug, Default)]
pub(super) struct StepFlight {
    id: Option<String>,
    /// `None` if it is not known, or its file has faults.
    mission: Option<Mission>,
    is_exam: bool,
}

impl StepFlight {
    pub fn mission_id(&self) -> Option<&str> {
        self.id.as_deref()
    }

    pub fn mission(&self) -> Option<&Mission> {
        self.mission.as_ref()
    }
}

/// The orders of a step: its lines, then its message, which would not stay on the screen while a mission opens.
/// A line that lets a mission fly changes the flight.
pub(super) fn read(
    step: &WrittenStep,
    setting: &LessonSetting<'_>,
    flight: &mut StepFlight,
    findings: &mut Findings,
) -> Vec<Deed> {
    let mut deeds = Vec::new();
    for line in &step.orders {
        match deed(line, setting, flight) {
            Ok(deed) => deeds.push(deed),
            Err(fault) => findings.faults.push(fault),
        }
    }
    deeds.extend(message(step, setting, findings));
    deeds
}

fn message(
    step: &WrittenStep,
    setting: &LessonSetting<'_>,
    findings: &mut Findings,
) -> Option<Deed> {
    let (english, ukrainian) = (step.message.as_ref(), step.message_uk.as_ref());
    let Some(english) = english else {
        if let Some(alone) = ukrainian {
            findings.fault(alone.span(), text!("lesson-message-alone"));
        }
        return None;
    };
    for written in std::iter::once(english).chain(ukrainian) {
        check_length(written.get_ref(), written.span(), findings);
    }
    let text = findings.text(english, ukrainian, "message_uk");
    let text = setting.locale.text(&text).into();
    Some(Deed::Message { text })
}

fn check_length(text: &str, place: Range<usize>, findings: &mut Findings) {
    if text.trim().chars().count() > LONGEST_MESSAGE {
        findings.fault(place, text!("lesson-message-long", most = LONGEST_MESSAGE));
    }
}

/// The order of a line.
fn deed(
    line: &Spanned<String>,
    setting: &LessonSetting<'_>,
    flight: &mut StepFlight,
) -> Result<Deed, Diagnostic> {
    let written = line.get_ref();
    let placed = |fault: Diagnostic| fault.in_string(line.span(), written.len());
    let whole = |message: Text| Diagnostic::new(line.span(), message);
    let deed = parsed(written).map_err(placed)?;
    if let Deed::Message { text } | Deed::Mark { text } = &deed
        && is_cut(text.as_str(), written)
    {
        return Err(whole(text!("lesson-message-long", most = LONGEST_MESSAGE)));
    }
    if let Deed::Fly {
        mission,
        exam,
        hold,
    } = deed
    {
        *flight = flown(mission.as_str(), exam, setting).map_err(whole)?;
        let mission = flight.mission_id().unwrap_or_default().into();
        return Ok(Deed::Fly {
            mission,
            exam,
            hold,
        });
    }
    if flight.is_exam && !deed.is_for_exams() {
        let fault = whole(text!("lesson-exam"));
        return Err(fault.with_help(text!("lesson-exam-help")));
    }
    if let Deed::Inject { name, when } = &deed {
        check_inject(name.as_str(), flight).map_err(whole)?;
        if let Some(when) = when {
            let checked = match flight.mission() {
                Some(mission) => mission.check_condition(when.as_str()),
                None => check_condition(when.as_str()),
            };
            checked.map_err(|fault| whole(fault.message))?;
        }
    }
    Ok(deed)
}

/// Whether a text was longer than it may be, and is only the beginning of what was written.
fn is_cut(text: &str, written: &str) -> bool {
    text.chars().count() >= LONGEST_MESSAGE && !written.trim_end().ends_with(text)
}

/// The order that a line without its verb gives to the seat of the lesson.
fn parsed(line: &str) -> Result<Deed, Diagnostic> {
    let whole = || 0..line.len();
    if line.trim().is_empty() || line.contains('\n') {
        return Err(Diagnostic::new(whole(), text!("lesson-order-none")));
    }
    let full = format!("{VERB}{line}");
    let context = Context {
        channel: Channel::Screen,
        ..Context::default()
    };
    let statement = language::parse(&full, &context).map_err(|fault| Diagnostic {
        span: fault.span.start.saturating_sub(VERB.len())
            ..fault.span.end.saturating_sub(VERB.len()),
        ..fault
    })?;
    match statement.meaning {
        Meaning::Console(ConsoleLine::Class(ClassLine::Give {
            seats: SeatChoice::Addressed,
            deed,
        })) => Ok(deed),
        Meaning::Console(ConsoleLine::Class(ClassLine::Give { .. })) => {
            Err(Diagnostic::new(whole(), text!("lesson-order-seat")))
        }
        _ => Err(Diagnostic::new(whole(), text!("lesson-order-none"))),
    }
}

/// The flight of a mission.
fn flown(written: &str, is_exam: bool, setting: &LessonSetting<'_>) -> Result<StepFlight, Text> {
    let ids = setting.missions.ids();
    let Some(id) = mission_meant(written, &ids) else {
        let known = ids.join(", ");
        return Err(text!("lesson-no-mission", name = written, known = known));
    };
    Ok(StepFlight {
        id: Some(id.to_owned()),
        mission: setting.missions.mission(id),
        is_exam,
    })
}

/// Checks that the mission that is flown permits an inject.
fn check_inject(name: &str, flight: &StepFlight) -> Result<(), Text> {
    let Some(id) = flight.mission_id() else {
        return Err(text!("lesson-inject-no-flight"));
    };
    let Some(mission) = flight.mission() else {
        return Ok(());
    };
    let injects = mission.injects();
    if injects.iter().any(|inject| inject.name == name) {
        return Ok(());
    }
    let known: Vec<&str> = injects.iter().map(|inject| inject.name.as_str()).collect();
    Err(if known.is_empty() {
        text!("lesson-inject-none", mission = id)
    } else {
        let known = known.join(", ");
        text!("lesson-inject", name = name, mission = id, known = known)
    })
}
