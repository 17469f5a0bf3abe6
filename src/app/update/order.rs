//! Commands to vehicles: their targets, the question before a dangerous command, and their ledger
//! entries.

use super::{own_fence, relay};
use crate::app::State;
use crate::app::action::Action;
use crate::app::effect::{Effect, Effects};
use crate::app::keymap::Place;
use crate::app::room::{Room, files, parameters};
use crate::app::state::{Confirm, Consequence, Overlay};
use crate::class::{self, Words};
use crate::commands::{Act, Command, Deed, Order, PlanCommand, PlanDeed};
use crate::crew::protocol::Confirmed;
use crate::diagnostic::Diagnostic;
use crate::language::{
    self, ClassLine, ConsoleLine, Context, Meaning, SeatChoice, Statement, words,
};
use crate::ledger::EntryId;
use crate::operator::{first_word, order_of};
use crate::pilot_in_command::Person;
use crate::text;
use crate::text::Text;
use crate::vehicle::{Severity, VehicleId};
use crate::vehicle_id::ranges;
use crate::verb::{CountsAs, Danger, Verb};

/// The maximum number of targets listed one by one.
const NAMED_TARGETS: usize = 12;

pub enum Given {
    /// A command to the console itself.
    Own(ConsoleLine),
    /// A command to vehicles or the mission.
    Order(Order),
}

/// Reads a line and finds its targets.
///
/// # Errors
/// The fault and its position in the line.
pub fn read(state: &State, line: &str) -> Result<Given, Diagnostic> {
    read_for(state, line, None, &state.addressed())
}

/// Reads a line of a person, or of the user of the console (`None`); without targets, `selection` applies.
///
/// # Errors
/// The fault and its position in the line.
pub fn read_for(
    state: &State,
    line: &str,
    by: Option<&Person>,
    selection: &[VehicleId],
) -> Result<Given, Diagnostic> {
    state.with_context(|context| {
        let statement = language::parse(line, context)?;
        if let Meaning::Console(own) = statement.meaning {
            return Ok(Given::Own(own));
        }
        if let Some(own) = for_watched_seat(state, line, &statement)? {
            return Ok(Given::Own(own));
        }
        permit(state, line, &statement)?;
        let statement = as_sent(state, line, statement, context)?;
        let is_flown = flown_by(state, by, statement.verb);
        let order = order_of(statement, line, context, selection, is_flown)?;
        check_file(&order, line)?;
        Ok(Given::Order(order))
    })
}

/// At the desk, while it watches the screen of a seat: a command to vehicles goes to those of the seat.
///
/// # Errors
/// The line is too long to be sent.
fn for_watched_seat(
    state: &State,
    line: &str,
    statement: &Statement,
) -> Result<Option<ConsoleLine>, Diagnostic> {
    let is_watching = state.rooms.class.page().seat().is_some();
    if !is_watching || !matches!(statement.meaning, Meaning::Act(_)) {
        return Ok(None);
    }
    let line = Words::whole(line)
        .ok_or_else(|| Diagnostic::new(first_word(line), text!("class-line-long")))?;
    Ok(Some(ConsoleLine::Class(ClassLine::Give {
        seats: SeatChoice::Addressed,
        deed: class::Deed::Command { line },
    })))
}

/// Refuses a download from several vehicles into one file, because each would need a file of its
/// own.
fn check_file(order: &Order, line: &str) -> Result<(), Diagnostic> {
    let Act::Command(Command::Plan(PlanCommand {
        deed: PlanDeed::Download { file },
        ..
    })) = &order.act
    else {
        return Ok(());
    };
    if order.targets.len() < 2 || file.contains("{id}") {
        return Ok(());
    }
    let place = words(line).pop().map_or(0..0, |word| word.span);
    let message = text!("order-one-file", file = file);
    Err(Diagnostic::new(place, message).with_help(text!("order-one-file-help")))
}

/// Reads a line that must be an order, and finds its targets.
///
/// # Errors
/// The fault and its position in the line.
pub fn prepare(state: &State, line: &str) -> Result<Order, Diagnostic> {
    state.with_context(|context| {
        let statement = language::parse(line, context)?;
        permit(state, line, &statement)?;
        let statement = as_sent(state, line, statement, context)?;
        let is_flown = flown_by(state, None, statement.verb);
        order_of(statement, line, context, &state.addressed(), is_flown)
    })
}

/// Whether vehicles take orders with a verb from a person, or from the user of the console (`None`).
fn flown_by<'a>(
    state: &'a State,
    by: Option<&'a Person>,
    verb: &Verb,
) -> impl Fn(VehicleId) -> bool + use<'a> {
    let duty = verb.duty;
    move |vehicle| state.session.pilots.refusal(vehicle, by, duty).is_none()
}

/// A statement as it is carried out. The host of a crew reads the lines of members again, and has other groups than they.
fn as_sent(
    state: &State,
    line: &str,
    statement: Statement,
    context: &Context<'_>,
) -> Result<Statement, Diagnostic> {
    if state.crew.member().is_none() {
        return Ok(statement);
    }
    let refused = |text: Text| Diagnostic::new(first_word(line), text);
    statement.in_numbers(context).map_err(refused)
}

fn permit(state: &State, line: &str, statement: &Statement) -> Result<(), Diagnostic> {
    if state.shows_past() {
        return Err(Diagnostic::new(first_word(line), text!("replay-refuses"))
            .with_help(text!("replay-refuses-help")));
    }
    if let Some(reason) = relay::obstacle(state, statement) {
        return Err(Diagnostic::new(first_word(line), reason));
    }
    if state.session.is_starting() && state.flown_mission().is_some() {
        return Err(Diagnostic::new(
            first_word(line),
            text!(
                "hangar-not-begun",
                key = state.key(Action::Show(Room::Hangar))
            ),
        ));
    }
    if let Some(reason) = state.holds_brief()
        && !moves_nothing(state, statement)
    {
        return Err(Diagnostic::new(first_word(line), reason));
    }
    if state.session.is_paused() && !moves_nothing(state, statement) {
        if let Some(reason) = state.keeps_frozen() {
            return Err(Diagnostic::new(first_word(line), reason));
        }
        return Err(
            Diagnostic::new(first_word(line), text!("pause-refuses")).with_help(text!(
                "pause-refuses-help",
                key = state.key(Action::PauseMission)
            )),
        );
    }
    match statement.meaning {
        // A pipe can wait on its own; other input cannot.
        Meaning::Wait(_) => {
            let fault = Diagnostic::new(first_word(line), text!("order-wait"));
            Err(fault.with_help(text!("order-wait-help")))
        }
        Meaning::Act(_) | Meaning::Console(_) => Ok(()),
    }
}

/// Whether a line may be given while time is stopped: it asks for a hint, rates the workload, or
/// states a prediction or a goal before takeoff.
fn moves_nothing(state: &State, statement: &Statement) -> bool {
    match (&statement.meaning, statement.verb.counts_as) {
        (Meaning::Act(_), CountsAs::Pledge) => state.can_pledge(),
        (Meaning::Act(_), counts_as) => counts_as.is_said_to_mission(),
        (Meaning::Wait(_) | Meaning::Console(_), _) => false,
    }
}

/// A text that describes what Enter would do with an order.
pub fn announced(state: &State, order: &Order) -> Text {
    if order.verb.counts_as.is_said_to_mission() {
        let key = state.keymap.key(Action::Submit, Place::Prompt);
        return text!("palette-confirms", key = key);
    }
    let targets = ranges(order.targets.iter().copied());
    let key = state.keymap.key(Action::Submit, Place::Prompt);
    let danger = match hazard(state, order) {
        Some(_) => Danger::Confirm,
        None => order.verb.danger,
    };
    match danger {
        Danger::None => text!("palette-sends", key = key, vehicles = targets),
        Danger::Confirm => text!("palette-asks", key = key, vehicles = targets),
    }
}

/// The reason to ask before an order is sent, beyond the danger of its verb; `None` without one.
pub fn hazard(state: &State, order: &Order) -> Option<Text> {
    let doubt = || parameters::order_doubt(state, order);
    let price = || hint_price(state, order);
    own_fence::hazard(state, order)
        .or_else(doubt)
        .or_else(price)
}

/// What the hint that an order requests costs; `None` if it is free.
fn hint_price(state: &State, order: &Order) -> Option<Text> {
    let (level, price) = state.session.mission()?.clues.next?;
    let asks = order.act == Act::Deed(Deed::Hint) && price > 0.0;
    let percent = (price * 100.0).round() as u32;
    asks.then(|| text!("order-hint-price", level = level, percent = percent))
}

/// Sends a command, or asks before a dangerous one.
pub fn give(state: &mut State, order: Order) -> Effects {
    let hazard = hazard(state, &order);
    if order.verb.danger == Danger::None && hazard.is_none() {
        return dispatch(state, order, Confirmed::Nothing);
    }
    if order.verb.counts_as.is_said_to_mission() {
        return ask_about_saying(state, order, hazard);
    }
    let count = order.targets.len();
    let named = if count > NAMED_TARGETS {
        ranges(order.targets.iter().copied())
    } else {
        let ids = order.targets.iter().map(VehicleId::to_string);
        ids.collect::<Vec<_>>().join(" ")
    };
    state.overlay = Some(Overlay::Confirm(Confirm {
        question: text!(
            "order-question",
            verb = order.verb.name.to_uppercase(),
            count = count,
            vehicles = named
        ),
        reason: hazard.unwrap_or_else(|| danger(&order)),
        answer: count.to_string(),
        typed: String::new(),
        cancelled: false,
        then: Consequence::Order(order),
    }));
    Effects::none()
}

/// What a dangerous verb does.
fn danger(order: &Order) -> Text {
    Text::new(format!("verb-{}", order.verb.name), Vec::new())
}

/// Asks before a message to the mission, which concerns no vehicle.
fn ask_about_saying(state: &mut State, order: Order, hazard: Option<Text>) -> Effects {
    let question = order.verb.name.to_uppercase().into();
    let then = Consequence::Order(order);
    state.ask(question, hazard.unwrap_or_default(), then);
    Effects::none()
}

/// Sends the uploads of a draft's lists; if any of them is dangerous, asks once for all of them.
pub fn give_uploads(state: &mut State, orders: Vec<Order>) -> Effects {
    let is_dangerous = |order: &&Order| hazard(state, order).is_some();
    let Some(worst) = orders.iter().find(is_dangerous).cloned() else {
        return upload(state, orders);
    };
    let effects = give(state, worst);
    if let Some(Overlay::Confirm(question)) = &mut state.overlay {
        question.then = Consequence::Uploads(orders);
    }
    effects
}

/// Sends an order that needs no further question; at a member of a crew, asks the host to do so.
pub fn dispatch(state: &mut State, order: Order, confirmed: Confirmed) -> Effects {
    if state.crew.member().is_some() {
        return relay::say(state, &order, confirmed);
    }
    Effects::from(send(state, order).effect)
}

/// Sends an order that was confirmed.
pub fn dispatch_confirmed(state: &mut State, order: Order) -> Effects {
    let confirmed = match hazard(state, &order) {
        Some(_) => Confirmed::Hazard,
        None => Confirmed::Danger,
    };
    dispatch(state, order, confirmed)
}

/// A line that a person other than the user of the console gives.
#[derive(Clone, Copy)]
pub struct LineFor<'a> {
    pub by: &'a Person,
    pub line: &'a str,
    /// The targets of a command that names none.
    pub selection: &'a [VehicleId],
    /// What that person has confirmed.
    pub confirmed: Confirmed,
}

/// Why a line of another person is not carried out.
pub enum UnfitLine {
    /// It is no command of a kind that this person may give.
    NoCommand,
    /// For this reason.
    Because(Text),
}

/// An order of another person that was carried out.
#[must_use = "the shell has to carry the effect out"]
pub struct OrderFor {
    pub sent: SentOrder,
    /// What that person had to confirm before; `None` for an order without danger.
    pub confirmed: Option<Text>,
}

/// Carries out a line that another person gives, for the vehicles that this person may command: the others refuse it.
/// `is_open` says whether the person may give such an order at all.
///
/// # Errors
/// It cannot be read, is none that is open, or needs a confirmation.
pub fn give_for(
    state: &mut State,
    said: LineFor<'_>,
    is_open: impl Fn(&Order) -> bool,
) -> Result<OrderFor, UnfitLine> {
    let order = match read_for(state, said.line, Some(said.by), said.selection) {
        Ok(Given::Order(order)) if is_open(&order) => order,
        Ok(_) => return Err(UnfitLine::NoCommand),
        Err(fault) => return Err(UnfitLine::Because(fault.message)),
    };
    let hazard = match hazard(state, &order) {
        // The user would be asked; the other person may not know of it.
        Some(hazard) if said.confirmed != Confirmed::Hazard => {
            return Err(UnfitLine::Because(hazard));
        }
        found => found,
    };
    let is_dangerous = order.verb.danger == Danger::Confirm;
    if said.confirmed == Confirmed::Nothing && is_dangerous {
        return Err(UnfitLine::Because(text!(
            "crew-unconfirmed",
            verb = order.verb.name
        )));
    }
    let confirmed = hazard.or_else(|| is_dangerous.then(|| danger(&order)));
    let by = Some(said.by.clone());
    let sent = send(state, Order { by, ..order });
    Ok(OrderFor { sent, confirmed })
}

/// An order entered in the ledger, and the effect that sends it.
#[must_use = "the shell has to carry the effect out"]
pub struct SentOrder {
    pub entry: EntryId,
    pub effect: Effect,
}

/// Opens a ledger entry for an order.
pub fn send(state: &mut State, order: Order) -> SentOrder {
    let now = state.now;
    if !order.verb.counts_as.is_said_to_mission() {
        state.leave_brief();
    }
    let entry = state
        .session
        .commands
        .open(now, order.given(), &order.targets);
    parameters::note_order(state, &order, entry);
    files::note_order(state, &order, entry);
    state.rooms.ledger.spoil();
    SentOrder {
        entry,
        effect: Effect::Order { entry, order },
    }
}

/// Sends the uploads of a draft's lists.
pub fn upload(state: &mut State, orders: Vec<Order>) -> Effects {
    if let Some(reason) = relay::own_files(state) {
        state.say(Severity::Warning, reason);
        return Effects::none();
    }
    let mut sent = Vec::new();
    for order in orders {
        sent.push(send(state, order));
    }
    let entries = sent.iter().map(|sent| sent.entry).collect();
    state.rooms.plans.note_uploads(entries);
    sent.into_iter().map(|sent| sent.effect).collect()
}
