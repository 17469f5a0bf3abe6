//! The hangar with a real ArduCopter, where `SORTIE_ARDUCOPTER` names one.

use std::collections::BTreeMap;
use std::path::PathBuf;

use sortie::hangar::{Config, Hangar, Launch, Limits, Restart, Stage};
use sortie::sitl::Kind;

fn config(folder: &tempfile::TempDir, program: PathBuf) -> Config {
    Config {
        programs: BTreeMap::from([(Kind::Copter, program)]),
        folder: folder.path().to_owned(),
        limits: Limits::default(),
        restart: Restart::Never,
        sortie: PathBuf::from(env!("CARGO_BIN_EXE_sortie")),
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_real_arducopter_becomes_ready() {
    let Some(program) = std::env::var_os("SORTIE_ARDUCOPTER") else {
        eprintln!("skipped: SORTIE_ARDUCOPTER names no arducopter");
        return;
    };
    let folder = tempfile::tempdir().expect("a temporary folder");
    let hangar = Hangar::open(config(&folder, program.into())).expect("it opens");
    let first = hangar.launch(Launch::default()).await.expect("it starts");
    let second = hangar.launch(Launch::default()).await.expect("it starts");
    assert_eq!((first, second), (1, 2));
    let mut seen = hangar.instances();
    seen.wait_for(|all| {
        eprintln!(
            "{:?}",
            all.values()
                .map(|i| (i.stage, i.parameters, i.fault.clone()))
                .collect::<Vec<_>>()
        );
        all.values().all(|instance| instance.stage == Stage::Ready)
    })
    .await
    .expect("it is open");
    hangar.stop(first).await.expect("it is there");
    assert_eq!(hangar.instances().borrow().len(), 1);
    hangar.close().await;
}
