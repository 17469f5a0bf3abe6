//! What each role reaches.

use super::*;

#[tokio::test]
async fn each_role_reaches_what_is_its_own() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut safety = Box::pin(member(folder.path(), "olena", Some(Role::Safety))).await;
    let mut looks = Box::pin(member(folder.path(), "petro", Some(Role::Observer))).await;
    until(&mut [&mut host, &mut safety, &mut looks], |aboard| {
        !aboard[1].is_waiting(3) && !aboard[2].is_waiting(3)
    })
    .await;
    host.say("all arm").await;
    until(&mut [&mut host, &mut safety, &mut looks], |aboard| {
        aboard[1]
            .last()
            .is_some_and(|(entry, _)| entry.is_final() && entry.line == "all arm")
    })
    .await;
    let message = |aboard: &Aboard| {
        let overlay = aboard.console.app.state().overlay();
        let Some(crate::app::state::Overlay::Palette(palette)) = overlay else {
            return String::new();
        };
        palette
            .fault()
            .map_or_else(String::new, |it| it.message.to_string())
    };
    safety.say("1 takeoff 10").await;
    assert_eq!(
        message(&safety),
        "this command is not part of your role: safety"
    );
    looks.say("1 disarm").await;
    assert_eq!(message(&looks), "observers give no commands");
    safety.say("1 disarm").await;
    until(&mut [&mut host, &mut safety, &mut looks], |aboard| {
        let is_safe = |vehicle: &Arc<crate::vehicle::Vehicle>| !vehicle.armed();
        aboard[0].session().vehicles().get(&1).is_some_and(is_safe)
    })
    .await;
    let (_, by) = host.last().expect("a command");
    let by = by.expect("another person");
    // The pilot reads who did what to which vehicle.
    let told = format!("{by} commands `disarm` to what you fly: 1");
    assert!(host.has_notice(&told));
    assert!(!safety.has_notice("to what you fly"));
}

#[tokio::test]
async fn who_flies_nothing_still_speaks_to_the_mission() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut host = Box::pin(host(folder.path(), THREE)).await;
    let mut sensors = Box::pin(member(folder.path(), "olena", Some(Role::Sensors))).await;
    until(&mut [&mut host, &mut sensors], |aboard| {
        !aboard[1].is_waiting(3)
    })
    .await;
    sensors.say("workload 4").await;
    let theirs = named(2);
    until(&mut [&mut host, &mut sensors], |aboard| {
        aboard[0]
            .last()
            .is_some_and(|(entry, by)| entry.line == "workload 4" && by.as_deref() == Some(&theirs))
    })
    .await;
}
