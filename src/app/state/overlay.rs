//! Overlays over a screen; one at a time.

use tui_input::Input;

use super::HelpPage;
use super::sticks::StickMode;
use crate::app::effect::Effect;
use crate::app::room_list::Room;
use crate::class::{Deed, Exam};
use crate::class_results::FoundFlights;
use crate::commands::Order;
use crate::diagnostic::Diagnostic;
use crate::language::Completion;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::workshop::Design;

/// An overlay. It takes all keys while it is open.
#[derive(Debug, Clone)]
pub enum Overlay {
    Palette(Palette),
    /// A question before a dangerous action.
    Confirm(Confirm),
    /// A prompt for a line of text.
    Prompt(Prompt),
    Profiles {
        /// The index of the chosen line.
        cursor: usize,
    },
    /// The sticks of a vehicle that is flown by keys.
    Sticks(StickMode),
    Help(HelpPage),
    Log {
        log: Log,
        /// The entry under the cursor; `None` follows the newest.
        cursor: Option<usize>,
    },
}

/// A list that can be searched backwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Log {
    Notices,
    /// Other aircraft, the most urgent first.
    Traffic,
    /// The moments of the replay.
    Moments,
}

/// The open command line.
#[derive(Debug, Clone, Default)]
pub struct Palette {
    /// The line and its cursor.
    pub(in crate::app) input: Input,
    /// The completions at the cursor, best first.
    pub(in crate::app) completions: Vec<Completion>,
    /// The completion that Tab has inserted.
    pub(in crate::app) chosen: Option<usize>,
    /// The targets of the line so far; empty if the line has none.
    pub(in crate::app) recipients: Text,
    /// The usage of the verb, or the next argument.
    pub(in crate::app) hint: Option<Text>,
    /// The effect of Enter on the line so far; `None` while it is incomplete.
    pub(in crate::app) outcome: Option<Text>,
    /// The line as Enter reads it, if it was typed in another keyboard layout.
    pub(in crate::app) reading: Option<String>,
    /// The text that a key has written, until the line is edited.
    pub(in crate::app) written: String,
    /// The fault of a finished word, or of the line when Enter was pressed.
    pub(in crate::app) fault: Option<Diagnostic>,
    /// The line before the first press of Tab.
    pub(in crate::app) before_tab: String,
    /// The history line shown, counted from the newest.
    pub(in crate::app) history_at: Option<usize>,
    /// The line that was being typed before the history was opened.
    pub(in crate::app) draft: String,
}

impl Palette {
    /// The line and its cursor.
    pub fn input(&self) -> &Input {
        &self.input
    }

    /// The completions at the cursor, best first.
    pub fn completions(&self) -> &[Completion] {
        &self.completions
    }

    /// The completion that Tab has inserted.
    pub fn chosen(&self) -> Option<usize> {
        self.chosen
    }

    /// The targets of the line so far; empty if it has none.
    pub fn recipients(&self) -> &Text {
        &self.recipients
    }

    /// The usage of the verb, or the next argument.
    pub fn hint(&self) -> Option<&Text> {
        self.hint.as_ref()
    }

    /// The effect of Enter on the line so far; `None` while it is incomplete.
    pub fn outcome(&self) -> Option<&Text> {
        self.outcome.as_ref()
    }

    /// The line as Enter reads it, if it was typed in another keyboard layout.
    pub fn reading(&self) -> Option<&str> {
        self.reading.as_deref()
    }

    /// The fault of a finished word, or of the line when Enter was pressed.
    pub fn fault(&self) -> Option<&Diagnostic> {
        self.fault.as_ref()
    }
}

/// The answer to a question about no number of vehicles.
pub const YES: &str = "y";

/// A question that only the exact answer confirms; any other key cancels it. After a wrong key,
/// further keys are ignored until Enter or Esc, because they are not meant for the screen below
/// either.
#[derive(Debug, Clone)]
pub struct Confirm {
    /// The action and its targets: `KILL vehicles 1 3 5`.
    pub(in crate::app) question: Text,
    /// The reason for the question.
    pub(in crate::app) reason: Text,
    /// The text to type.
    pub(in crate::app) answer: String,
    /// The part typed so far.
    pub(in crate::app) typed: String,
    /// Whether a wrong key has cancelled the question.
    pub(in crate::app) cancelled: bool,
    pub(in crate::app) then: Consequence,
}

impl Confirm {
    /// A question that `y` confirms.
    pub fn new(question: Text, reason: Text, then: Consequence) -> Self {
        Self {
            question,
            reason,
            answer: YES.to_owned(),
            typed: String::new(),
            cancelled: false,
            then,
        }
    }

    /// The action and its targets: `KILL vehicles 1 3 5`.
    pub fn question(&self) -> &Text {
        &self.question
    }

    /// The reason for the question.
    pub fn reason(&self) -> &Text {
        &self.reason
    }

    /// The text to type.
    pub fn answer(&self) -> &str {
        &self.answer
    }

    /// The part typed so far.
    pub fn typed(&self) -> &str {
        &self.typed
    }

    /// Whether a wrong key has cancelled the question.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled
    }

    /// Whether a single key answers the question.
    pub fn wants_one_key(&self) -> bool {
        self.answer.chars().count() == 1
    }

    /// The text to type, with a label if it is not obvious.
    pub fn wanted(&self) -> Text {
        match self.then {
            Consequence::Order(_) | Consequence::Uploads(_) if self.answer != YES => {
                text!("ask-how-many", answer = &self.answer)
            }
            Consequence::Order(_)
            | Consequence::Uploads(_)
            | Consequence::Effect(_)
            | Consequence::Parameters(_)
            | Consequence::Design(_)
            | Consequence::JoinClass
            | Consequence::BeginExam { .. }
            | Consequence::EndExam
            | Consequence::EndExamAndQuit
            | Consequence::ReplayHandedIn(_)
            | Consequence::Instruct { .. }
            | Consequence::CloseDraft => self.answer.as_str().into(),
        }
    }
}

/// The result of a confirmed question.
#[derive(Debug, Clone)]
pub enum Consequence {
    Order(Order),
    /// Upload the lists of drafts.
    Uploads(Vec<Order>),
    /// Close the current draft of a plan.
    CloseDraft,
    /// Pass an effect to the shell.
    Effect(Effect),
    /// Set parameters one after another.
    Parameters(Vec<ParameterSetting>),
    /// Replace the design on the bench.
    Design(Design),
    /// Asks whether the trainee joins the class.
    JoinClass,
    /// Let these seats of the class take part in an exam.
    BeginExam {
        exam: Box<Exam>,
        seats: Vec<usize>,
    },
    /// End the exam of the class.
    EndExam,
    /// End the exam of the class, and the program.
    EndExamAndQuit,
    /// Replay a flight that was handed in.
    ReplayHandedIn(FoundFlights),
    /// Give an order to these seats of the class.
    Instruct {
        seats: Vec<usize>,
        deed: Deed,
    },
}

/// One value for some vehicles.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterSetting {
    pub name: String,
    pub value: f64,
    /// The vehicles on which to set the value, in ascending order.
    pub vehicles: Vec<VehicleId>,
    /// How many more times to send the command if there is no answer; setting the same value twice
    /// does no harm.
    pub again: u8,
}

impl ParameterSetting {
    /// A value for some vehicles.
    pub fn new(name: &str, value: f64, vehicles: Vec<VehicleId>) -> Self {
        Self {
            name: name.to_owned(),
            value,
            vehicles,
            again: AGAIN,
        }
    }
}

/// The number of repeats by default.
const AGAIN: u8 = 2;

/// A prompt for a line.
#[derive(Debug, Clone)]
pub struct Prompt {
    pub(in crate::app) purpose: Purpose,
    /// The line and its cursor.
    pub(in crate::app) input: Input,
    /// Whether the line is still the proposed text: the first letter typed replaces it.
    pub(in crate::app) is_proposal: bool,
    /// The error of the last entry.
    pub(in crate::app) fault: Option<Text>,
}

impl Prompt {
    pub fn purpose(&self) -> &Purpose {
        &self.purpose
    }

    /// The line and its cursor.
    pub fn input(&self) -> &Input {
        &self.input
    }

    /// The error of the last entry.
    pub fn fault(&self) -> Option<&Text> {
        self.fault.as_ref()
    }

    pub fn new(purpose: Purpose) -> Self {
        Self {
            purpose,
            input: Input::default(),
            is_proposal: false,
            fault: None,
        }
    }
}

/// The purpose of a prompt.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Purpose {
    /// The addresses of vehicles, separated by spaces.
    Connect,
    /// The name of a new profile.
    NewProfile,
    /// The seed of a practice flight of the mission with this id.
    Seed(String),
    /// The filter of a room's list.
    Filter(Room),
    /// A parameter's new value.
    Parameter {
        name: String,
        vehicles: Vec<VehicleId>,
    },
    /// The file to copy into a folder of a vehicle.
    PutFile { vehicle: VehicleId, folder: String },
    /// The file to save parameters to.
    SaveParameters,
    /// The file to load parameters from.
    LoadParameters,
    /// The file or the vehicle to compare parameters with.
    CompareParameters,
    /// The name under which to store the design.
    SaveDesign,
    /// The name for a copy of the design with this name.
    CopyDesign(String),
    /// The new name for the design with this name.
    RenameDesign(String),
    /// The file to write a design to.
    ExportDesign,
    /// The file to read a design from.
    ImportDesign,
}

impl Purpose {
    /// Whether the entry takes effect at every key, not only at Enter.
    pub fn is_live(&self) -> bool {
        matches!(self, Self::Filter(_))
    }
}
