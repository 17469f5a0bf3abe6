//! What can lie over a screen; one at a time.

use tui_input::Input;

use super::HelpPage;
use crate::app::effect::Effect;
use crate::app::room_list::Room;
use crate::commands::Order;
use crate::diagnostic::Diagnostic;
use crate::language::Completion;
use crate::text;
use crate::text::Text;
use crate::vehicle::VehicleId;
use crate::workshop::Design;

/// An overlay. It takes the keys while it is there.
#[derive(Debug, Clone)]
pub enum Overlay {
    Palette(Palette),
    /// A question before something dangerous.
    Confirm(Confirm),
    /// A line that is asked for.
    Prompt(Prompt),
    Profiles {
        /// The line under the cursor.
        cursor: usize,
    },
    Help(HelpPage),
    Log {
        log: Log,
        /// The entry under the cursor; `None` is the newest, also when newer ones come.
        cursor: Option<usize>,
    },
}

/// What can be looked back through.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Log {
    Notices,
    /// The moments of what is replayed.
    Moments,
}

/// The command line while it is being written.
#[derive(Debug, Clone, Default)]
pub struct Palette {
    /// The line and its cursor.
    pub(in crate::app) input: Input,
    /// What could stand at the cursor, best first.
    pub(in crate::app) completions: Vec<Completion>,
    /// The completion that Tab has put in.
    pub(in crate::app) chosen: Option<usize>,
    /// The vehicles that the line as it stands is for; empty where it is for none.
    pub(in crate::app) recipients: Text,
    /// The usage of the verb, or what comes next.
    pub(in crate::app) hint: Option<Text>,
    /// What Enter would do with the line as it stands; `None` while it is not complete.
    pub(in crate::app) outcome: Option<Text>,
    /// What is wrong with a word that has been finished, or was when the line was given.
    pub(in crate::app) fault: Option<Diagnostic>,
    /// The line before Tab was pressed first.
    pub(in crate::app) before_tab: String,
    /// Which line of the history is shown, counted from the newest.
    pub(in crate::app) history_at: Option<usize>,
    /// The line that was being written before the history was looked through.
    pub(in crate::app) draft: String,
}

impl Palette {
    /// The line and its cursor.
    pub fn input(&self) -> &Input {
        &self.input
    }

    /// What could stand at the cursor, best first.
    pub fn completions(&self) -> &[Completion] {
        &self.completions
    }

    /// The completion that Tab has put in.
    pub fn chosen(&self) -> Option<usize> {
        self.chosen
    }

    /// The vehicles that the line as it stands is for; empty where it is for none.
    pub fn recipients(&self) -> &Text {
        &self.recipients
    }

    /// The usage of the verb, or what comes next.
    pub fn hint(&self) -> Option<&Text> {
        self.hint.as_ref()
    }

    /// What Enter would do with the line as it stands; `None` while it is not complete.
    pub fn outcome(&self) -> Option<&Text> {
        self.outcome.as_ref()
    }

    /// What is wrong with a word that has been finished, or was when the line was given.
    pub fn fault(&self) -> Option<&Diagnostic> {
        self.fault.as_ref()
    }
}

/// A question that only its answer confirms; any other key takes the thing back. Keys after a wrong one are
/// swallowed until Enter or Esc, because they were not meant for the screen below either.
#[derive(Debug, Clone)]
pub struct Confirm {
    /// What would happen, and to whom: `KILL vehicles 1 3 5`.
    pub(in crate::app) question: Text,
    /// Why it is asked.
    pub(in crate::app) reason: Text,
    /// What has to be typed.
    pub(in crate::app) answer: String,
    /// What has been typed of it.
    pub(in crate::app) typed: String,
    /// Whether a wrong key has taken the thing back.
    pub(in crate::app) cancelled: bool,
    pub(in crate::app) then: Consequence,
}

impl Confirm {
    /// A question that `y` answers with yes.
    pub fn new(question: Text, reason: Text, then: Consequence) -> Self {
        Self {
            question,
            reason,
            answer: "y".to_owned(),
            typed: String::new(),
            cancelled: false,
            then,
        }
    }

    /// What would happen, and to whom: `KILL vehicles 1 3 5`.
    pub fn question(&self) -> &Text {
        &self.question
    }

    /// Why it is asked.
    pub fn reason(&self) -> &Text {
        &self.reason
    }

    /// What has to be typed.
    pub fn answer(&self) -> &str {
        &self.answer
    }

    /// What has been typed of it.
    pub fn typed(&self) -> &str {
        &self.typed
    }

    /// Whether a wrong key has taken the thing back.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled
    }

    /// Whether a single key answers it.
    pub fn wants_one_key(&self) -> bool {
        self.answer.chars().count() == 1
    }

    /// What has to be typed, and what it is where that is not plain.
    pub fn wanted(&self) -> Text {
        match self.then {
            Consequence::Order(_) => text!("ask-how-many", answer = &self.answer),
            Consequence::Effect(_) | Consequence::Parameters(_) | Consequence::Design(_) => {
                self.answer.as_str().into()
            }
        }
    }
}

/// What a confirmed question leads to.
#[derive(Debug, Clone)]
pub enum Consequence {
    /// An order goes out.
    Order(Order),
    /// The shell does something.
    Effect(Effect),
    /// Parameters are set one after the other.
    Parameters(Vec<ParameterSetting>),
    /// A design takes the place of the one on the workshop's bench.
    Design(Design),
}

/// One value for some vehicles.
#[derive(Debug, Clone, PartialEq)]
pub struct ParameterSetting {
    pub name: String,
    /// The value to take.
    pub value: f32,
    /// The vehicles that it is set on, in rising order.
    pub vehicles: Vec<VehicleId>,
    /// How often it is given again where no answer comes: taking the same value twice does no harm.
    pub again: u8,
}

impl ParameterSetting {
    /// A value for some vehicles.
    pub fn new(name: &str, value: f32, vehicles: Vec<VehicleId>) -> Self {
        Self {
            name: name.to_owned(),
            value,
            vehicles,
            again: AGAIN,
        }
    }
}

/// A setting is given again so often.
const AGAIN: u8 = 2;

/// A line that is asked for.
#[derive(Debug, Clone)]
pub struct Prompt {
    /// What it is for.
    pub(in crate::app) purpose: Purpose,
    /// The line and its cursor.
    pub(in crate::app) input: Input,
    /// Whether the line is still the proposed text: the first letter typed replaces it.
    pub(in crate::app) is_proposal: bool,
    /// What was wrong with it.
    pub(in crate::app) fault: Option<Text>,
}

impl Prompt {
    /// What it is for.
    pub fn purpose(&self) -> &Purpose {
        &self.purpose
    }

    /// The line and its cursor.
    pub fn input(&self) -> &Input {
        &self.input
    }

    /// What was wrong with it.
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

/// What a line is asked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Purpose {
    /// The addresses of vehicles, with blanks between them.
    Connect,
    /// The name of a new profile.
    NewProfile,
    /// The seed of a practice flight of the mission with this id.
    Seed(String),
    /// What the names of a room's list have to contain.
    Filter(Room),
    /// A parameter's new value.
    Parameter {
        name: String,
        /// The vehicles that shall take it.
        vehicles: Vec<VehicleId>,
    },
    /// The file that parameters are saved to.
    SaveParameters,
    /// The file that parameters are loaded from.
    LoadParameters,
    /// The file or the vehicle that parameters are compared with.
    CompareParameters,
    /// The name under which the workshop's design is kept.
    SaveDesign,
    /// The name of a copy of the design of this name.
    CopyDesign(String),
    /// Another name for the design of this name.
    RenameDesign(String),
    /// The file that a design is written to.
    ExportDesign,
    /// The file that a design is read from.
    ImportDesign,
}

impl Purpose {
    /// Whether every key counts, and not only Enter.
    pub fn is_live(&self) -> bool {
        matches!(self, Self::Filter(_))
    }
}
