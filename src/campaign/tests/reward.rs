use super::*;
use crate::campaign::{OpenedItem, Reward};

#[test]
fn a_reward_tells_what_a_flight_changed_and_why() {
    let course = course();
    let mut history = vec![CareerEntry::Flight(flight(&course, "one", 800, 1))];
    let reward = |history: &[CareerEntry], flown: CareerFlight| {
        let before = standing(history);
        let mut after = before.clone();
        after.enter(&CareerEntry::Flight(flown.clone()));
        Reward::between(&before, &after, &course, &flown)
    };
    let flown = CareerFlight {
        wear: 7,
        ..flight(&course, "two", 900, 1)
    };
    let second = reward(&history, flown.clone());
    assert_eq!((second.pay_credits, second.wear_credits), (380, 7));
    assert_eq!((second.licence_before, second.licence), (2, 4));
    let ids = |opened: &[OpenedItem]| opened.iter().map(|it| it.id.clone()).collect::<Vec<_>>();
    assert_eq!(ids(&second.missions), ["three", "drill"]);
    assert_eq!(second.skills.len(), 1);
    assert!(second.skills[0].after_percent > second.skills[0].before_percent);
    let lines: Vec<String> = second.lines().iter().map(ToString::to_string).collect();
    assert_eq!(
        lines[0],
        "credits +380, -7 for wear and damage to your vehicles, 1233 now"
    );
    assert!(
        lines.iter().any(|line| line == "licence for 2 -> 4 drones"),
        "{lines:?}"
    );

    let next = second.next.as_ref().map(ToString::to_string);
    assert_eq!(next.as_deref(), Some("Go on with \"three\"."));

    history.push(CareerEntry::Flight(flown));
    let unpaid = |flown| reward(&history, flown).lines()[0].to_string();
    let again = flight(&course, "two", 850, 1);
    assert_eq!(
        unpaid(again),
        "no credits: only a score above 900 earns more; 1233 now"
    );
    let mut best = history.clone();
    best.push(CareerEntry::Flight(flight(&course, "two", 1000, 1)));
    let whole = reward(&best, flight(&course, "two", 1000, 1)).lines();
    assert!(
        whole[0]
            .to_string()
            .contains("your best score is 1000, the highest possible"),
        "{whole:?}"
    );
    let failed = flight(&course, "three", 300, 1);
    assert_eq!(
        unpaid(failed),
        "no credits: the mission was not passed; 1233 now"
    );
    let practice = CareerFlight {
        stake: Stake::Practice,
        ..flight(&course, "three", 900, 1)
    };
    let next = reward(&history, practice.clone()).next;
    assert_eq!(
        next.map(|it| it.to_string()).as_deref(),
        Some("Fly this mission for credits: practice opens no other.")
    );
    assert_eq!(
        unpaid(practice),
        "no credits: practice earns none; 1233 now"
    );
}

#[test]
fn a_loss_takes_no_more_than_there_is_and_the_reward_says_how_much() {
    let course = course();
    let flown = CareerFlight {
        wear: 9000,
        ..flight(&course, "one", 300, 1)
    };
    let before = standing(&[]);
    let after = standing(&[CareerEntry::Flight(flown.clone())]);
    let reward = Reward::between(&before, &after, &course, &flown);
    assert_eq!((reward.wear_credits, reward.credits), (500, 0));
}

#[test]
fn what_does_not_count_is_not_paid_whatever_wear_takes() {
    let course = course();
    let first = CareerEntry::Flight(CareerFlight {
        stake: Stake::Daily,
        wear: 760,
        ..flight(&course, "one", 600, 1)
    });
    let before = standing(&[first]);
    assert_eq!(before.credits(), 60);
    let reward = |stake| {
        let flown = CareerFlight {
            stake,
            wear: 300,
            ..flight(&course, "one", 900, 1)
        };
        let mut after = before.clone();
        after.enter(&CareerEntry::Flight(flown.clone()));
        Reward::between(&before, &after, &course, &flown)
    };
    let lines = [
        (Stake::Practice, "practice earns none"),
        (Stake::Daily, "the seed of the day counts once a day"),
    ];
    for (stake, why) in lines {
        let reward = reward(stake);
        assert_eq!((reward.pay_credits, reward.wear_credits), (0, 60));
        assert_eq!(reward.skills, []);
        let line = format!("no credits: {why}; -60 for wear and damage to your vehicles, 0 now");
        assert_eq!(reward.lines()[0].to_string(), line);
    }
}
