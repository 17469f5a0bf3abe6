//! Profiles: choosing, creating and leaving them, and the data of their trainee.

use sortie::app::effect::CareerEffect;
use sortie::app::state::{Purpose, Trainee};
use sortie::campaign::Aids;
use sortie::text::Language;

use super::*;

#[test]
fn profiles_are_chosen_made_and_left() {
    let names = |console: &Console| console.state().training().trainees();
    let mut console = trained_by(career());
    assert_eq!(
        names(&console),
        [
            Trainee::Known("oksana".to_owned()),
            Trainee::Known("taras".to_owned()),
            Trainee::New,
            Trainee::Guest
        ]
    );
    // The current choice is under the cursor, and selecting it changes nothing.
    console.press("u").press("enter");
    assert!(console.effects.is_empty() && console.state().overlay().is_none());
    console.press("u").press("j").press("enter");
    assert_eq!(
        console.effects,
        [Effect::Career(CareerEffect::Choose("taras".to_owned()))]
    );
    console.press("u").press("end").press("enter");
    assert_eq!(console.effects, [Effect::Career(CareerEffect::Leave)]);
    console.press("u").press("esc");
    assert!(console.effects.is_empty() && console.state().overlay().is_none());
    console.press("u").press("end").press("k").press("enter");
    console.write("  ").press("enter");
    assert!(console.effects.is_empty(), "a name has letters");
    console.write("Лесь").press("enter");
    assert_eq!(
        console.effects,
        [Effect::Career(CareerEffect::Create("Лесь".to_owned()))]
    );
}

#[test]
fn the_prompt_for_a_name_stays_with_the_reason_until_there_is_a_profile() {
    let mut console = nobody();
    console
        .press("u")
        .press("enter")
        .write("oksana")
        .press("enter");
    assert_eq!(
        console.effects,
        [Effect::Career(CareerEffect::Create("oksana".to_owned()))]
    );
    console.hear(Event::Failed("there is one already".into()));
    let screen = console.screen(80, 24);
    assert!(screen.contains("there is one already"), "{screen}");
    let is_prompt = |console: &Console| match console.state().overlay() {
        Some(Overlay::Prompt(prompt)) => *prompt.purpose() == Purpose::NewProfile,
        _ => false,
    };
    assert!(is_prompt(&console));
    console.hear(CareerEvent::Career(None));
    assert!(is_prompt(&console), "nobody has come");
    console.hear(CareerEvent::Career(Some(Box::new(newcomer()))));
    assert!(!is_prompt(&console));
}

#[test]
fn nobody_takes_over_a_flight() {
    let mut console = trained_by(career());
    in_flight(&mut console);
    console.press("H").press("u");
    assert!(console.state().overlay().is_none());
    assert!(
        said(&console).contains("end it first"),
        "{}",
        said(&console)
    );
    console.hear(SessionEvent::MissionEnded(Box::new(fixtures::report())));
    console.at(5).press("H").press("u");
    assert!(console.state().overlay().is_some(), "it is over");
}

#[test]
fn what_was_chosen_for_missions_goes_with_who_chose_it() {
    let mut console = with_a_fleet(career());
    console.hear(CareerEvent::Career(Some(Box::new(career()))));
    assert_eq!(fleets(&console), 1);
    console.hear(CareerEvent::Career(None));
    assert_eq!(fleets(&console), 0);
}

#[test]
fn advice_goes_round_and_is_kept() {
    for (now, next) in [
        (Aids::Fading, Aids::None),
        (Aids::None, Aids::Full),
        (Aids::Full, Aids::Fading),
    ] {
        let career = Career {
            aids: now,
            ..career()
        };
        let mut console = trained_by(career);
        console.press("T");
        assert_eq!(console.state().room(), Room::Standing);
        console.press("a");
        assert_eq!(
            console.effects,
            [Effect::Career(CareerEffect::SetAids(next))]
        );
    }
    let mut console = nobody();
    console.press("T").press("a");
    assert!(console.effects.is_empty());
    assert!(said(&console).contains("choose a profile"));
}

#[test]
fn a_trainee_is_met_in_their_language_until_they_choose_another() {
    let language = |console: &Console| console.state().locale().language();
    let ukrainian = |name: &str| Career {
        language: Some(Language::Ukrainian),
        name: name.to_owned(),
        ..newcomer()
    };
    let meet = |console: &mut Console, career: Career| {
        console.hear(CareerEvent::Career(Some(Box::new(career))));
    };
    let mut console = nobody();
    console.give("set lang en");
    assert_eq!(console.effects, [], "nobody is there to remember it for");
    meet(&mut console, ukrainian("oksana"));
    assert_eq!(language(&console), Language::Ukrainian);
    console.give("set lang en");
    assert_eq!(
        console.effects,
        [Effect::Career(CareerEffect::SetLanguage(Language::English))]
    );
    assert_eq!(language(&console), Language::English);
    meet(&mut console, ukrainian("oksana"));
    assert_eq!(language(&console), Language::English, "it is the same one");
    console.give("set symbols ascii");
    meet(&mut console, ukrainian("taras"));
    assert_eq!(language(&console), Language::English, "no letters for it");
}
