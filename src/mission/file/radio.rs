//! `[radio]` and `[instructor]`.

use crate::mission::event::standard::Standard;
use crate::mission::format::{FileTable, NameKind, NamedValue, flag, list, named, number, point};
use crate::mission::radio::{Model, Radio, Set};

/// The radio that all vehicles carry.
pub(super) fn radio(table: &mut FileTable<'_>) -> Option<Radio> {
    let model_form = named(NameKind::Radio, radio_names, Model::by_id);
    let model = table.need("model", model_form, "radio of every vehicle");
    let station = table.may(
        "station",
        point(),
        "position of the ground station (default the first pad)",
    );
    let antenna = number(0.5, 100.0, "m");
    let antenna_m = table.or(
        "antenna",
        antenna,
        Radio::USUAL_ANTENNA_M,
        "height of the ground station's antenna",
    );
    let relays = table.may(
        "relays",
        flag(),
        "whether vehicles in the air relay messages (by default, as set in the model)",
    );
    let set = Set::of(model?);
    let first_pad = table.draft().pads.first().copied();
    Some(Radio {
        own: Some(Set {
            relays: relays.unwrap_or(set.relays),
            ..set
        }),
        station: station.or(first_pad).unwrap_or_default(),
        antenna_m,
    })
}

fn radio_names() -> Vec<&'static str> {
    Model::all().map(|model| model.id).collect()
}

/// The value that names a standard threat.
pub(super) const fn threat() -> NamedValue<Standard> {
    named(
        NameKind::Threat,
        || Standard::names().to_vec(),
        Standard::named,
    )
}

/// The threats that an instructor may trigger.
pub(super) fn may_inject(table: &mut FileTable<'_>) -> Option<Vec<Standard>> {
    let threats_form = list(threat(), 0, usize::MAX);
    let threats = table.may(
        "may_inject",
        threats_form,
        "`gust` (7 m/s more for 20 s), `wind_shift` (60 degrees), `gnss_jam` and `link_loss` (one vehicle, 20 s), \
         `motor_fail` (a motor keeps 75 % of its thrust), `battery_cold` and `battery_cell` (94 % and 88 % of the voltage), \
         `person` and `aircraft` (pass through the first task zone)",
    );
    Some(threats.unwrap_or_default())
}
