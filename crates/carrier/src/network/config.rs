//! The settings of Zenoh. Nothing of its default configuration is used that opens sockets, discovers, or lets anybody in.

use std::collections::BTreeSet;
use std::net::IpAddr;

use ct_codecs::{Base64, Encoder as _};
use nix::ifaddrs::getifaddrs;
use serde_json::{Value, json};
use zenoh::Config;

use super::Channel;
use super::certificates::desk_certificate;
use super::folder::NetworkDesk;
use super::frame::LONGEST_FRAME;
use crate::fault::NetworkFault;
use crate::join_line::JoinLine;

/// The time in ms without a word after which a link has ended, and the number of words in it.
const LEASE_MS: u64 = 3000;
const KEEP_ALIVE: u64 = 4;
/// The number of batches in the queue of a link: the most that Zenoh allows.
const BATCHES: u64 = 16;
/// The time in ms for connecting to a desk.
const CONNECT_MS: u64 = 5000;
/// The time in ms for a TLS handshake at the desk: a connection that says nothing takes the place of others.
const HANDSHAKE_MS: u64 = 3000;

/// The maximum number of consoles of one seat.
pub(super) const CONSOLES_OF_A_SEAT: usize = 4;

/// The settings of a desk.
pub(super) fn of_desk(desk: &NetworkDesk) -> Result<Config, NetworkFault> {
    let keys = &desk.keys;
    let certificate = desk_certificate(&keys.class, &keys.key.0, hosts(desk))?;
    let endpoint = format!(
        "tls/{}#tls_handshake_timeout_ms={HANDSHAKE_MS}",
        desk.listen
    );
    config(&json!({
        "mode": "router",
        "listen": { "endpoints": [endpoint] },
        "access_control": access_list(&keys.class, keys.seats.keys()),
        "low_pass_filter": [{
            "id": "longest",
            "flows": ["ingress"],
            "messages": ["put", "delete", "query", "reply"],
            "key_exprs": ["**"],
            "size_limit": LONGEST_FRAME,
        }],
        "transport": transport(keys.seats.len() * CONSOLES_OF_A_SEAT + 8, &json!({
            "enable_mtls": true,
            "root_ca_certificate_base64": pem("CERTIFICATE", &keys.seats_certificate.0),
            "listen_certificate_base64": pem("CERTIFICATE", &certificate),
            "listen_private_key_base64": pem("PRIVATE KEY", &keys.key.0),
        })),
    }))
}

/// The settings of a seat whose desk is at an address.
pub(super) fn of_seat(line: &JoinLine, address: &str) -> Result<Config, NetworkFault> {
    config(&json!({
        "mode": "client",
        "connect": {
            "endpoints": [format!("tls/{address}")],
            "timeout_ms": CONNECT_MS,
            "exit_on_failure": true,
        },
        "listen": { "endpoints": [] },
        "transport": transport(1, &json!({
            "enable_mtls": true,
            "verify_name_on_connect": true,
            "root_ca_certificate_base64": pem("CERTIFICATE", &line.desk_certificate),
            "connect_certificate_base64": pem("CERTIFICATE", &line.certificate),
            "connect_private_key_base64": pem("PRIVATE KEY", &line.key),
        })),
    }))
}

fn config(own: &Value) -> Result<Config, NetworkFault> {
    let common = json!({
        "scouting": { "multicast": { "enabled": false }, "gossip": { "enabled": false } },
        "timestamping": { "enabled": false },
        "adminspace": { "enabled": false },
    });
    let mut all = own.clone();
    if let (Some(all), Value::Object(common)) = (all.as_object_mut(), common) {
        all.extend(common);
    }
    // Zenoh's own words may contain the settings, and so the key.
    let refused = |_| NetworkFault::Crypto("the settings of Zenoh".to_owned());
    Config::from_json5(&all.to_string()).map_err(refused)
}

fn transport(sessions: usize, tls: &Value) -> Value {
    json!({
        "unicast": { "max_sessions": sessions, "max_links": 1, "qos": { "enabled": false } },
        "link": {
            "protocols": ["tls"],
            "tx": {
                "lease": LEASE_MS,
                "keep_alive": KEEP_ALIVE,
                "queue": {
                    "size": { "data": BATCHES },
                    // What has no room is dropped at once: a sender that waited would hold up others.
                    "congestion_control": {
                        "drop": { "wait_before_drop": 0, "max_wait_before_drop_fragments": 0 },
                    },
                },
            },
            "rx": { "max_message_size": 2 * LONGEST_FRAME },
            "tls": tls,
        },
    })
}

/// Who may do what: nobody anything, except each seat on its own keys.
fn access_list<'a>(class: &str, seats: impl Iterator<Item = &'a String>) -> Value {
    let mut rules = Vec::new();
    let mut subjects = Vec::new();
    let mut policies = Vec::new();
    for seat in seats {
        let Channel { up, down } = Channel::of_seat(class, seat);
        let mut names = Vec::new();
        for (name, flow, message, key) in [
            ("says", "ingress", "put", &up),
            ("listens", "ingress", "declare_subscriber", &down),
            ("is heard", "egress", "declare_subscriber", &up),
            ("is told", "egress", "put", &down),
        ] {
            let id = format!("{seat} {name}");
            rules.push(json!({
                "id": id,
                "permission": "allow",
                "flows": [flow],
                "messages": [message],
                "key_exprs": [key],
            }));
            names.push(id);
        }
        subjects.push(json!({ "id": seat, "cert_common_names": [seat] }));
        policies.push(json!({ "subjects": [seat], "rules": names }));
    }
    json!({
        "enabled": true,
        "default_permission": "deny",
        "rules": rules,
        "subjects": subjects,
        "policies": policies,
    })
}

/// The names and addresses under which seats may reach this desk: a certificate is checked against that which the seat
/// has called.
fn hosts(desk: &NetworkDesk) -> Vec<String> {
    let of_files = desk.keys.addresses.iter().chain([&desk.listen]);
    let of_files = of_files.filter_map(|it| it.rsplit_once(':'));
    let of_files = of_files.map(|(host, _)| host.trim_matches(['[', ']']).to_owned());
    let of_machine = getifaddrs().into_iter().flatten().filter_map(|it| {
        let address = it.address?;
        let v4 = address.as_sockaddr_in().map(|it| IpAddr::from(it.ip()));
        v4.or_else(|| address.as_sockaddr_in6().map(|it| IpAddr::from(it.ip())))
    });
    let name = nix::unistd::gethostname().ok();
    let name = name.and_then(|it| it.into_string().ok());
    let all: BTreeSet<String> = of_files
        .chain(of_machine.map(|it| it.to_string()))
        .chain(name)
        .chain(["localhost".to_owned()])
        .collect();
    all.into_iter().filter(|it| it.is_ascii()).collect()
}

/// A part of a PEM file, in Base64 again, as Zenoh takes it.
pub(super) fn pem(label: &str, der: &[u8]) -> String {
    let text = Base64::encode_to_string(der).unwrap_or_default();
    let lines: Vec<&str> = text
        .as_bytes()
        .chunks(64)
        .filter_map(|it| str::from_utf8(it).ok())
        .collect();
    let pem = format!(
        "-----BEGIN {label}-----\n{}\n-----END {label}-----\n",
        lines.join("\n")
    );
    Base64::encode_to_string(pem).unwrap_or_default()
}
