//! A copy of a world flies as the world does.

use super::*;

/// Steps a world, and enters the inputs that another one had; returns the hash of its state at the end.
fn fly(world: &mut World, inputs: &[Input], until: u64) -> u64 {
    let mut inputs = inputs.iter().peekable();
    let mut output = Vec::new();
    loop {
        while let Some(input) = inputs.next_if(|it| it.step <= world.steps()) {
            assert!(world.enter(input));
        }
        if world.steps() >= until {
            return world.fingerprint(0);
        }
        world.step();
        world.take_output(PortId::numbered(0, 0), &mut output);
    }
}

#[test]
fn a_copy_flies_as_the_world_did_with_the_same_inputs() {
    let mut ground = Ground::in_world(&WorldConfig::row(1, start())).hover(20.0);
    ground.set("SIM_WIND_SPD", 8.0);
    ground.set("SIM_WIND_TURB", 3.0);
    ground.run(3.0);
    let captured = ground.world.copy();
    let at = captured.fingerprint(0);
    ground.world.keep_inputs();
    ground.goto([30.0, -10.0, -25.0]);
    ground.run(8.0);
    let inputs = ground.world.take_inputs();
    assert!(!inputs.is_empty());
    let (until, flown) = (ground.world.steps(), ground.world.fingerprint(0));
    assert_ne!(at, flown);
    for _ in 0..2 {
        let mut recalled = captured.copy();
        assert_eq!(recalled.fingerprint(0), at);
        assert_eq!(fly(&mut recalled, &inputs, until), flown);
    }
    // Without them, it flies elsewhere.
    let mut other = captured.copy();
    assert_ne!(fly(&mut other, &[], until), flown);
}
