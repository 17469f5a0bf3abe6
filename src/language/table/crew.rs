//! The verb for a crew.

use super::{Built, console};
use crate::language::VehicleChoice;
use crate::language::argument::{Argument, Arguments, Kind};
use crate::language::console::{ConsoleLine, CrewLine, ProposalLine};
use crate::language::names::NameList;
use crate::language::verb::{Form, Scope, VerbRow};
use crate::verb::Verb;

pub(super) static ROWS: &[VerbRow] = &[VerbRow {
    verb: Verb::unsent("crew"),
    scope: Scope::Console,
    aliases: &[],
    examples: &[
        "crew",
        "crew offer 3 to bohdan",
        "crew ask 3",
        "crew accept",
        "crew accept 3",
        "crew accept 3 from bohdan",
        "crew decline",
    ],
    forms: &[
        Form::new(&[], |_| line(CrewLine::List)),
        Form::new(&[Argument::flag("offer", ""), VEHICLES, TO], |given| {
            let to = given.required_word("name")?.to_owned();
            let vehicles = vehicles(given);
            line(CrewLine::Offer { vehicles, to })
        }),
        Form::new(&[Argument::flag("ask", ""), VEHICLES], |given| {
            let vehicles = vehicles(given);
            line(CrewLine::Ask { vehicles })
        }),
        Form::new(
            &[Argument::flag("accept", ""), VEHICLES.optional(), FROM],
            |given| line(CrewLine::Accept(proposal(given))),
        ),
        Form::new(
            &[Argument::flag("decline", ""), VEHICLES.optional(), FROM],
            |given| line(CrewLine::Decline(proposal(given))),
        ),
    ],
}];

const VEHICLES: Argument = Argument::value("vehicles", Kind::Vehicles, "argument-crew-vehicles");
const TO: Argument = Argument::keyed(
    "to",
    "name",
    Kind::Name(NameList::Crew),
    "argument-crew-name",
);

const FROM: Argument = Argument::keyed(
    "from",
    "name",
    Kind::Name(NameList::Crew),
    "argument-crew-name",
)
.optional();

/// The proposal that is meant.
fn proposal(given: &Arguments) -> ProposalLine {
    ProposalLine {
        vehicles: given.vehicles("vehicles"),
        from: given.word("name").map(str::to_owned),
    }
}

/// The vehicles that are meant; they are required.
fn vehicles(given: &Arguments) -> VehicleChoice {
    given.vehicles("vehicles").unwrap_or(VehicleChoice::None)
}

fn line(line: CrewLine) -> Built {
    console(ConsoleLine::Crew(line))
}
