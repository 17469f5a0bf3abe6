//! Handing vehicles over, with the consent of both sides.

use std::collections::BTreeSet;
use std::time::Duration;

use serde::{Deserialize, Serialize};

use super::{Crew, CrewChange, CrewFault, Role};
use crate::pilot_in_command::{Person, PilotsInCommand};
use crate::text;
use crate::text::Text;
use crate::vehicle_id::{VehicleId, ranges};

/// How long a proposal waits for an answer.
const WAITS: Duration = Duration::from_secs(60);
/// The maximum number of proposals of one person that wait.
const MOST_OF_ONE: usize = 8;

/// What the host or a member does about the pilots of vehicles.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CrewDeed {
    /// Offer own vehicles to the host or to another pilot.
    Offer {
        vehicles: Vec<VehicleId>,
        to: String,
    },
    /// Ask the pilot of vehicles for them.
    Ask { vehicles: Vec<VehicleId> },
    /// Let the vehicles of a proposal change hands.
    Accept(ProposalChoice),
    /// Answer a proposal with no; its vehicles stay where they are.
    Decline(ProposalChoice),
}

/// Which of the proposals that wait for a person's answer is meant. Without anything named, it is the only one.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ProposalChoice {
    /// The vehicles of the proposal, all of them; empty if they are not named.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vehicles: Vec<VehicleId>,
    /// Who has made it; `None` if the person is not named.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<String>,
}

impl ProposalChoice {
    fn means(&self, proposal: &Proposal) -> bool {
        let has_vehicles = self.vehicles.is_empty() || are_same(&self.vehicles, &proposal.vehicles);
        let from = self.from.as_deref();
        has_vehicles && from.is_none_or(|name| proposal.proposer().name() == name)
    }
}

/// Whether two lists have the same vehicles, in any order.
fn are_same(one: &[VehicleId], other: &[VehicleId]) -> bool {
    let set = |vehicles: &[VehicleId]| vehicles.iter().copied().collect::<BTreeSet<_>>();
    set(one) == set(other)
}

/// A proposal to hand vehicles over.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Proposal {
    pub vehicles: Vec<VehicleId>,
    /// Who flies them now.
    pub giver: Person,
    pub taker: Person,
    /// Whether the taker asks; otherwise the giver offers.
    pub is_asked: bool,
    /// When it ends, by the wall clock.
    ends_at: Duration,
}

impl Proposal {
    /// Who has to answer.
    pub fn answerer(&self) -> &Person {
        if self.is_asked {
            &self.giver
        } else {
            &self.taker
        }
    }

    /// Whether the other side has proposed the same: one offers what the other asks for.
    fn is_equal_of_other_side(&self, other: &Self) -> bool {
        self.is_asked != other.is_asked
            && (&self.giver, &self.taker) == (&other.giver, &other.taker)
            && are_same(&self.vehicles, &other.vehicles)
    }

    /// Who has made it.
    pub fn proposer(&self) -> &Person {
        if self.is_asked {
            &self.taker
        } else {
            &self.giver
        }
    }

    /// The proposal with the words to type, for the one who has to answer.
    pub fn text(&self) -> Text {
        let who = self.proposer().name();
        let vehicles = ranges(self.vehicles.iter().copied());
        if self.is_asked {
            text!("crew-asks", who = who, vehicles = vehicles)
        } else {
            text!("crew-offers", who = who, vehicles = vehicles)
        }
    }

    /// The proposal for everybody on the crew.
    pub fn open(&self) -> Text {
        let (who, to) = (self.proposer().name(), self.answerer().name());
        let vehicles = ranges(self.vehicles.iter().copied());
        if self.is_asked {
            text!("crew-open-asks", who = who, from = to, vehicles = vehicles)
        } else {
            text!("crew-open-offers", who = who, to = to, vehicles = vehicles)
        }
    }

    /// The proposal in a list of several.
    pub fn listed(&self) -> Text {
        let who = self.proposer().name();
        let vehicles = ranges(self.vehicles.iter().copied());
        if self.is_asked {
            text!("crew-listed-asks", who = who, vehicles = vehicles)
        } else {
            text!("crew-listed-offers", who = who, vehicles = vehicles)
        }
    }
}

/// What came of a deed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DeedOutcome {
    /// Somebody has to answer.
    Proposed(Proposal),
    /// The vehicles have another pilot.
    Changed(CrewChange),
    /// The proposal was declined.
    Declined(Proposal),
}

impl Crew {
    /// Carries out what the host or a member wants. `all` are the vehicles of the session.
    ///
    /// # Errors
    /// It is not possible.
    pub fn act(
        &mut self,
        who: &Person,
        deed: &CrewDeed,
        scene: &mut CrewScene<'_>,
    ) -> Result<DeedOutcome, CrewFault> {
        match deed {
            CrewDeed::Offer { vehicles, to } => self.offer(who, vehicles, to, scene),
            CrewDeed::Ask { vehicles } => self.ask(who, vehicles, scene),
            CrewDeed::Accept(choice) => self.accept(who, choice, scene),
            CrewDeed::Decline(choice) => {
                let declined = self.take_proposal(who, choice, scene)?;
                Ok(DeedOutcome::Declined(declined))
            }
        }
    }

    fn offer(
        &mut self,
        giver: &Person,
        vehicles: &[VehicleId],
        to: &str,
        scene: &mut CrewScene<'_>,
    ) -> Result<DeedOutcome, CrewFault> {
        scene.check(vehicles)?;
        let taker = self.person(to)?;
        if taker == *giver {
            return Err(CrewFault::Oneself);
        }
        self.check_pilot(&taker)?;
        let is_other = |vehicle: &VehicleId| self.pilot(*vehicle, scene.pilots) != giver;
        let others: Vec<_> = vehicles.iter().copied().filter(is_other).collect();
        if !others.is_empty() {
            return Err(CrewFault::NotYours(others));
        }
        let proposal = Proposal {
            vehicles: vehicles.to_vec(),
            giver: giver.clone(),
            taker,
            is_asked: false,
            ends_at: scene.now + WAITS,
        };
        self.propose(proposal, scene)
    }

    fn ask(
        &mut self,
        taker: &Person,
        vehicles: &[VehicleId],
        scene: &mut CrewScene<'_>,
    ) -> Result<DeedOutcome, CrewFault> {
        scene.check(vehicles)?;
        self.check_pilot(taker)?;
        let pilot = |vehicle: &VehicleId| self.pilot(*vehicle, scene.pilots).clone();
        let own = |vehicle: &VehicleId| pilot(vehicle) == *taker;
        let own: Vec<_> = vehicles.iter().copied().filter(own).collect();
        if !own.is_empty() {
            return Err(CrewFault::YoursAlready(own));
        }
        let mut givers = vehicles.iter().map(pilot);
        let giver = givers.next().ok_or(CrewFault::NoVehicle)?;
        if givers.any(|it| it != giver) {
            return Err(CrewFault::SeveralPilots);
        }
        let proposal = Proposal {
            vehicles: vehicles.to_vec(),
            giver,
            taker: taker.clone(),
            is_asked: true,
            ends_at: scene.now + WAITS,
        };
        self.propose(proposal, scene)
    }

    /// Adds a proposal. One that repeats another begins its time again; one of the other side accepts it.
    fn propose(
        &mut self,
        proposal: Proposal,
        scene: &mut CrewScene<'_>,
    ) -> Result<DeedOutcome, CrewFault> {
        let mut open = self.proposals.iter();
        let is_agreed = open.any(|it| {
            it.is_equal_of_other_side(&proposal) && self.stands(it, scene.pilots, scene.now)
        });
        if is_agreed {
            return Ok(self.hand_over(proposal, scene));
        }
        self.proposals.retain(|it| {
            it.proposer() != proposal.proposer()
                || it.answerer() != proposal.answerer()
                || !are_same(&it.vehicles, &proposal.vehicles)
        });
        let all = self.proposals.iter();
        let of_one = all.filter(|it| it.proposer() == proposal.proposer());
        if of_one.count() >= MOST_OF_ONE {
            return Err(CrewFault::ManyProposals);
        }
        self.proposals.push(proposal.clone());
        Ok(DeedOutcome::Proposed(proposal))
    }

    fn accept(
        &mut self,
        who: &Person,
        choice: &ProposalChoice,
        scene: &mut CrewScene<'_>,
    ) -> Result<DeedOutcome, CrewFault> {
        let agreed = self.take_proposal(who, choice, scene)?;
        Ok(self.hand_over(agreed, scene))
    }

    /// Makes the taker of a proposal the pilot, once both sides agree.
    fn hand_over(&mut self, agreed: Proposal, scene: &mut CrewScene<'_>) -> DeedOutcome {
        let Proposal {
            vehicles,
            giver,
            taker,
            ..
        } = agreed;
        if taker == self.host {
            scene.pilots.hand_back(&vehicles, &giver);
        } else {
            scene.pilots.take_over(&vehicles, &taker);
        }
        // Other proposals about these vehicles are void now.
        self.settle(scene.pilots, scene.now);
        DeedOutcome::Changed(CrewChange::HandedOver {
            vehicles,
            from: giver,
            to: taker,
        })
    }

    /// Takes the proposal that a person answers.
    fn take_proposal(
        &mut self,
        who: &Person,
        choice: &ProposalChoice,
        scene: &CrewScene<'_>,
    ) -> Result<Proposal, CrewFault> {
        let all = self.proposals.iter().enumerate();
        let (places, open): (Vec<usize>, Vec<&Proposal>) =
            all.filter(|(_, it)| it.answerer() == who).unzip();
        let meant: Vec<usize> = std::iter::zip(places, &open)
            .filter(|(_, it)| choice.means(it))
            .map(|(place, _)| place)
            .collect();
        let listed = || open.iter().map(|&it| it.clone()).collect();
        let place = match meant[..] {
            [place] => place,
            _ if open.is_empty() => return Err(CrewFault::NothingProposed),
            [] => return Err(CrewFault::OtherProposals(listed())),
            _ => return Err(CrewFault::SeveralProposals(listed())),
        };
        let proposal = self.proposals.remove(place);
        if self.stands(&proposal, scene.pilots, scene.now) {
            Ok(proposal)
        } else {
            Err(CrewFault::Overtaken)
        }
    }

    /// Whether a proposal can still be accepted.
    fn stands(&self, proposal: &Proposal, pilots: &PilotsInCommand, now: Duration) -> bool {
        let mut vehicles = proposal.vehicles.iter();
        now < proposal.ends_at && vehicles.all(|it| self.pilot(*it, pilots) == &proposal.giver)
    }

    /// Drops the proposals that have ended: after their time, or because the vehicles have another pilot. Returns those
    /// that nobody has answered in time.
    pub fn settle(&mut self, pilots: &PilotsInCommand, now: Duration) -> Vec<Proposal> {
        let all = std::mem::take(&mut self.proposals);
        let (standing, over): (Vec<_>, Vec<_>) =
            all.into_iter().partition(|it| self.stands(it, pilots, now));
        self.proposals = standing;
        over.into_iter().filter(|it| now >= it.ends_at).collect()
    }

    /// Gives the proposals more time.
    pub(super) fn postpone(&mut self, time: Duration) {
        for proposal in &mut self.proposals {
            proposal.ends_at += time;
        }
    }

    /// Who flies a vehicle.
    pub fn pilot<'a>(&'a self, vehicle: VehicleId, pilots: &'a PilotsInCommand) -> &'a Person {
        pilots.of(vehicle).unwrap_or(&self.host)
    }

    /// The person with a name.
    fn person(&self, name: &str) -> Result<Person, CrewFault> {
        let persons = self.members().map(|it| &it.person);
        let mut persons = std::iter::once(&self.host).chain(persons);
        let found = persons.find(|it| it.name() == name);
        found
            .cloned()
            .ok_or_else(|| CrewFault::Nobody(name.to_owned()))
    }

    /// Checks that a person may fly vehicles: the host, and members who are pilots.
    fn check_pilot(&self, person: &Person) -> Result<(), CrewFault> {
        let mut members = self.members();
        let is_pilot = members.any(|it| it.person == *person && it.role == Role::Pilot);
        if is_pilot || *person == self.host {
            return Ok(());
        }
        Err(CrewFault::NoPilot(person.name().to_owned()))
    }
}

/// The vehicles, their pilots and the time at which something happens in a crew.
#[derive(Debug)]
pub struct CrewScene<'a> {
    /// The vehicles of the session.
    pub vehicles: &'a [VehicleId],
    pub pilots: &'a mut PilotsInCommand,
    /// The time now, by the wall clock.
    pub now: Duration,
}

impl CrewScene<'_> {
    fn check(&self, vehicles: &[VehicleId]) -> Result<(), CrewFault> {
        let mut named = vehicles.iter();
        if vehicles.is_empty() || named.any(|it| !self.vehicles.contains(it)) {
            return Err(CrewFault::NoVehicle);
        }
        Ok(())
    }
}
