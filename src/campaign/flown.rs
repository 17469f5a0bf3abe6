//! A finished flight as an entry of a career.

use super::attempt::day_and_stake;
use super::{CareerFlight, Evidence, FlownDesign, Stake, wear};
use crate::mission::Mission;
use crate::scoring::Report;

impl CareerFlight {
    /// The career entry for a flight of a mission that ended on the day `ended`, in days since 1970
    /// (UTC). A daily flight with the seed of another day is practice.
    pub fn of(mission: &Mission, report: &Report, stake: Stake, ended: i64) -> Self {
        let (day, stake) = day_and_stake(stake, report.seed, ended);
        Self {
            mission: mission.id.clone(),
            drill_of: mission.summary.drill_of.clone(),
            tier: mission.career.rewards.xp_tier,
            reward: mission.career.rewards.credits,
            // A flight abandoned before any drone was heard counts as well.
            vehicles: u8::try_from(report.vehicles).unwrap_or(u8::MAX).max(1),
            stake,
            flown_by: report.flown_by,
            day,
            score: report.score,
            passed: report.passed,
            medal: report.medal,
            evidence: Evidence::of(report, mission),
            wear: wear(own(mission, report)),
            imported: false,
        }
    }
}

/// The trainee's own drones on a flight, without those that the mission lent.
fn own<'a>(mission: &'a Mission, report: &'a Report) -> impl Iterator<Item = FlownDesign<'a>> {
    let seats = mission.designs().into_iter().zip(&report.usage);
    seats.filter_map(|(design, used)| {
        Some(FlownDesign {
            design: design?,
            airborne_s: used.airborne_s,
            has_crashed: used.crashed,
        })
    })
}
