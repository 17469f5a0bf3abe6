//! The hangar's HTTP service over real sockets, with stand-ins for `arducopter`.

use std::collections::BTreeMap;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::time::Duration;

use serde_json::Value;
use sortie::hangar::client::RemoteHangar;
use sortie::hangar::service::{self, Program, ServiceBounds, ServiceSetup};
use sortie::hangar::{Hangar, HangarLimits, HangarSetup, HangarToken, Restart};
use sortie::sitl::SitlKind;
use tokio::io::{AsyncReadExt as _, AsyncWriteExt as _};
use tokio::net::{TcpListener, TcpStream};
use tokio::task::JoinHandle;
use tokio_util::sync::CancellationToken;

use crate::stand_in::{Behaviour, StandIn};

mod doors;
mod events;
mod far;
mod flight;
mod limits;
mod program;
mod requests;

const PATIENCE: Duration = Duration::from_secs(90);

/// The user of a connection: always that of this process.
#[expect(clippy::unnecessary_wraps, reason = "one of several of its type")]
fn ours(_: SocketAddr, _: SocketAddr) -> Option<u32> {
    Some(nix::unistd::geteuid().as_raw())
}

/// A service that runs in this process.
struct Served {
    address: SocketAddr,
    token: HangarToken,
    cancel: CancellationToken,
    task: JoinHandle<std::io::Result<()>>,
    _stand_in: Option<StandIn>,
    _folder: tempfile::TempDir,
}

impl Served {
    /// A service with room for this many stand-ins.
    async fn start(instances: u16) -> Self {
        Self::with(instances, Some(Behaviour::Normal), |_| ()).await
    }

    /// Ends the service and starts another one at the same address, with the same token.
    async fn again(self) -> Self {
        let (address, token) = (self.address, self.token.clone());
        self.end().await;
        let adjust = |setup: &mut ServiceSetup| setup.token = token;
        let listener = TcpListener::bind(address).await.expect("it is free again");
        Self::at(listener, 1, Some(Behaviour::Normal), adjust)
    }

    async fn with(
        instances: u16,
        behaviour: Option<Behaviour>,
        adjust: impl FnOnce(&mut ServiceSetup),
    ) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        Self::at(listener, instances, behaviour, adjust)
    }

    fn at(
        listener: TcpListener,
        instances: u16,
        behaviour: Option<Behaviour>,
        adjust: impl FnOnce(&mut ServiceSetup),
    ) -> Self {
        let stand_in = behaviour.map(StandIn::new);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let limits = HangarLimits {
            instances,
            memory_mib: 4096,
            ..HangarLimits::default()
        };
        let programs = stand_in.iter().map(|one| (SitlKind::Copter, one.program()));
        let config = HangarSetup {
            programs: programs.collect::<BTreeMap<_, _>>(),
            folder: folder.path().to_owned(),
            limits,
            restart: Restart::Never,
            sortie: PathBuf::from(env!("CARGO_BIN_EXE_sortie")),
        };
        let mut setup = ServiceSetup {
            token: HangarToken::random().expect("random numbers"),
            require_token: false,
            expose: false,
            bounds: ServiceBounds::default(),
            owner: ours,
            programs: vec![Program {
                kind: SitlKind::Copter,
                file: "arducopter".to_owned(),
                identity: "a stand-in".to_owned(),
            }],
            restart: Restart::Never,
            limits,
        };
        adjust(&mut setup);
        let address = listener.local_addr().expect("it is bound");
        let hangar = Hangar::open(config).expect("it opens");
        let cancel = CancellationToken::new();
        let token = setup.token.clone();
        let task = tokio::spawn(service::serve(listener, hangar, setup, cancel.clone()));
        Self {
            address,
            token,
            cancel,
            task,
            _stand_in: stand_in,
            _folder: folder,
        }
    }

    fn remote(&self) -> RemoteHangar {
        let address = format!("http://{}", self.address).parse();
        RemoteHangar::new(address.expect("an address"), Some(self.token.clone()))
    }

    async fn connect(&self) -> TcpStream {
        TcpStream::connect(self.address).await.expect("it listens")
    }

    /// Sends a request without a body.
    async fn ask(&self, method: &str, path: &str) -> Answer {
        self.send(method, path, &[], "").await
    }

    async fn post(&self, body: &str) -> Answer {
        let json = "Content-Type: application/json";
        self.send("POST", "/vehicles", &[json], body).await
    }

    async fn send(&self, method: &str, path: &str, headers: &[&str], body: &str) -> Answer {
        let mut head = format!("{method} {path} HTTP/1.1\r\nConnection: close\r\n");
        if !headers.iter().any(|header| header.starts_with("Host:")) {
            head.push_str("Host: ");
            head.push_str(&self.address.to_string());
            head.push_str("\r\n");
        }
        for header in headers {
            head.push_str(header);
            head.push_str("\r\n");
        }
        if !body.is_empty() {
            head.push_str("Content-Length: ");
            head.push_str(&body.len().to_string());
            head.push_str("\r\n");
        }
        self.raw(format!("{head}\r\n{body}").as_bytes()).await
    }

    async fn raw(&self, bytes: &[u8]) -> Answer {
        let mut stream = self.connect().await;
        // A service that refuses early may close before everything is sent.
        let _ = stream.write_all(bytes).await;
        Answer::read(&mut stream).await
    }

    /// Ends the service and its instances.
    async fn end(self) {
        self.cancel.cancel();
        let over = tokio::time::timeout(PATIENCE, self.task).await;
        over.expect("in time").expect("no panic").expect("no error");
    }
}

#[derive(Debug)]
struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Answer {
    async fn read(stream: &mut TcpStream) -> Self {
        let mut bytes = Vec::new();
        // A connection that is reset after the answer counts as closed.
        let _ = tokio::time::timeout(PATIENCE, stream.read_to_end(&mut bytes))
            .await
            .expect("it answers");
        let text = String::from_utf8_lossy(&bytes);
        let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
        let status = head.split(' ').nth(1).and_then(|word| word.parse().ok());
        Self {
            status: status.unwrap_or(0),
            head: head.to_ascii_lowercase(),
            body: body.to_owned(),
        }
    }

    fn json(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }

    /// The text of a refusal: the fault and the advice.
    fn problem(&self) -> String {
        let json = self.json();
        let error = json["error"].as_str().expect("every refusal has an error");
        format!("{error} / {}", json["hint"].as_str().unwrap_or_default())
    }
}
