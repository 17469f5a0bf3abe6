//! Programs that pose as the desk.

use serde_json::{Value, json};
use zenoh::Config;
use zenoh::key_expr::KeyExpr;

use super::attacks::{Ear, refused, session, talk};
use super::*;
use crate::fault::{ClassFault, NetworkFault};
use crate::network::frame::Frame;

/// A router of the attacker: with its own keys, or with a certificate that it has got.
async fn false_router(listen: &str, certificate: &[u8], key: &[u8]) -> zenoh::Result<Session> {
    let tls = json!({
        "listen_certificate_base64": config::pem("CERTIFICATE", certificate),
        "listen_private_key_base64": config::pem("PRIVATE KEY", key),
    });
    let settings: Value = json!({
        "mode": "router",
        "listen": { "endpoints": [format!("tls/{listen}")] },
        "scouting": { "multicast": { "enabled": false }, "gossip": { "enabled": false } },
        "transport": { "link": { "tls": tls } },
    });
    zenoh::open(Config::from_json5(&settings.to_string())?).await
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_false_desk_is_not_found() {
    let (_parent, lab) = lab(2);
    let (_other_parent, other) = super::lab(1);
    // A desk of the same name with other keys, and a seat that poses as the desk.
    let line = lab.line(2);
    for (certificate, key) in [
        (
            other.line(1).desk_certificate,
            other.desk().keys.key.0.clone(),
        ),
        (line.certificate.clone(), line.key.clone()),
    ] {
        let router = false_router(&lab.listen, &certificate, &key)
            .await
            .expect("it opens");
        let mut greetings = Ear::new(&router, "**").await;
        let mut seat = join(lab.line(1));
        let fault = refused(&mut seat).await;
        assert!(
            matches!(*fault, ClassFault::Network(NetworkFault::NotTheDesk(_))),
            "{fault:?}"
        );
        assert!(greetings.is_silent(), "the seat has said nothing");
        router.close().await.expect("it closes");
    }
}

/// Even if TLS trusts the false desk, as it trusts every public authority: what it has recorded of the real one, it
/// cannot use.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn what_a_false_desk_has_recorded_opens_no_connection() {
    let (_parent, lab) = lab(1);
    let mut desk = open(&lab.desk()).await.expect("it opens");
    let recorder = session(&lab.line(1)).await;
    let mut ear = Ear::new(&recorder, "sortie/1/9-A/seat-01/*/down").await;
    let mut seat = join(lab.line(1));
    let kept = talk(&mut desk, &mut seat).await;
    let (_, opening) = ear.next().await;
    let (_, here) = ear.next().await;
    drop((seat, kept, desk));

    let (_other_parent, other) = super::lab(1);
    let false_desk = other.desk();
    let hosts = vec!["127.0.0.1".to_owned()];
    let key = &false_desk.keys.key.0;
    let certificate = certificates::desk_certificate("9-A", key, hosts).expect("made");
    let router = false_router(&other.listen, &certificate, key)
        .await
        .expect("it opens");
    let mut greetings = Ear::new(&router, "sortie/1/9-A/seat-01/*/up").await;
    let mut deceived = join(JoinLine {
        addresses: vec![other.listen.clone()],
        desk_certificate: other.line(1).desk_certificate,
        ..lab.line(1)
    });
    let (up, _) = greetings.next().await;
    let down = KeyExpr::try_from(up.replace("/up", "/down")).expect("a key");
    for bytes in [opening, here] {
        router.put(&down, bytes).await.expect("sent");
    }
    let fault = refused(&mut deceived).await;
    assert!(
        matches!(*fault, ClassFault::Network(NetworkFault::Unknown { .. })),
        "{fault:?}"
    );
    while let Ok((_, bytes)) = greetings.heard.try_recv() {
        assert!(Frame::may_be_hello(&bytes), "it has said only its greeting");
    }
}
