//! `[[crew]]`: the places of a crew.

use std::collections::BTreeSet;
use std::ops::Range;

use crate::crew::{Post, Role};
use crate::mission::format::{FileTable, NameKind, named, text};
use crate::text;
use crate::vehicle_id::{VehicleId, VehicleIds, ranges};

/// A place as the file has it.
pub(super) struct WrittenPost {
    post: Post,
    /// Where the vehicles are written.
    written: Option<Range<usize>>,
}

pub(super) fn post(table: &mut FileTable<'_>) -> Option<WrittenPost> {
    let role = table.need(
        "role",
        named(NameKind::CrewRole, Role::in_missions, Role::in_mission),
        "what the member does: fly own vehicles, report and operate the payloads of every vehicle, or make every vehicle \
         safe",
    );
    let vehicles = table.may(
        "vehicles",
        text("numbers such as `1-3`"),
        "the vehicles that a pilot flies from the beginning",
    );
    let written = vehicles.as_ref().map(toml::Spanned::span);
    let ids = match vehicles.map(|it| it.get_ref().parse::<VehicleIds>()) {
        Some(Ok(ids)) => ids.iter().collect(),
        Some(Err(fault)) => {
            table.fault_of("vehicles", fault);
            Vec::new()
        }
        None => Vec::new(),
    };
    let role = role?;
    if role != Role::Pilot && written.is_some() {
        table.fault_of("vehicles", text!("fault-crew-no-pilot", role = role.name()));
    }
    Some(WrittenPost {
        post: Post {
            role,
            vehicles: ids,
        },
        written,
    })
}

/// The places, after a check that every vehicle exists and has one pilot.
pub(super) fn checked(file: &mut FileTable<'_>, posts: Vec<WrittenPost>) -> Vec<Post> {
    let count = file.draft().pads.len();
    let mut taken: BTreeSet<VehicleId> = BTreeSet::new();
    for WrittenPost { post, written } in &posts {
        let Some(written) = written.clone() else {
            continue;
        };
        let faults = &mut file.draft().faults;
        let strange = post.vehicles.iter().filter(|&&id| usize::from(id) > count);
        let strange = ranges(strange.copied());
        // Without pads, the fleet has a fault of its own.
        if !strange.is_empty() && count > 0 {
            let fault = text!("fault-crew-vehicles", vehicles = strange, count = count);
            faults.add(written.clone(), fault);
        }
        let twice = post.vehicles.iter().filter(|&&id| !taken.insert(id));
        let twice = ranges(twice.copied().collect::<Vec<_>>());
        if !twice.is_empty() {
            faults.add(written, text!("fault-crew-twice", vehicles = twice));
        }
    }
    posts.into_iter().map(|it| it.post).collect()
}
