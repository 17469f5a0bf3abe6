//! The console's fleet against a real ArduCopter, named by `SORTIE_ARDUCOPTER`.

use std::fmt::Write as _;
use std::fs;
use std::net::UdpSocket;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use sortie::parameters::read_defaults;

use crate::fleet::files::to_and_fro;
use crate::fleet::{Console, signing};
use crate::sitl::{self, Sitl};

/// The number of the SITL instance: its TCP port is 5760 plus ten per instance, which avoids ports
/// that other programs usually use.
const INSTANCE: u16 = 83;

/// The parameters that a new vehicle needs before it can be armed: a frame, and calibrations that are not all zero.
pub(crate) fn parameters() -> String {
    let mut text = String::from("FRAME_CLASS 1\nFRAME_TYPE 0\nBATT_MONITOR 4\n");
    for compass in ["", "2", "3"] {
        for (axis, offset) in [("X", 5), ("Y", 13), ("Z", -18)] {
            writeln!(text, "COMPASS_OFS{compass}_{axis} {offset}").expect("a string takes it");
        }
    }
    for sensor in ["", "2"] {
        for axis in ["X", "Y", "Z"] {
            writeln!(text, "INS_ACC{sensor}OFFS_{axis} 0.001").expect("a string takes it");
            writeln!(text, "INS_ACC{sensor}SCAL_{axis} 1.001").expect("a string takes it");
        }
    }
    for channel in 1..=8 {
        writeln!(
            text,
            "RC{channel}_MIN 1000\nRC{channel}_MAX 2000\nRC{channel}_TRIM 1500"
        )
        .expect("a string takes it");
    }
    text
}

/// Starts a SITL as vehicle 7 with the parameters in the folder, in real time.
fn run(folder: &Path, instance: u16, arguments: &str) -> Sitl {
    let line =
        format!("{arguments} --speedup 1 --slave 0 --sysid 7 --defaults copter.parm -I {instance}");
    let words: Vec<&str> = line.split(' ').collect();
    Sitl::start(&sitl::arducopter(), folder, &words)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn a_real_arducopter_flies_the_classic_flow() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    fs::write(folder.path().join("copter.parm"), parameters()).expect("written");
    let _sitl = run(
        folder.path(),
        INSTANCE,
        "--model quad --home -35.363262,149.165237,584,0",
    );
    let mut console = Console::start();
    console.connect(&format!("tcp:127.0.0.1:{}", 5760 + 10 * INSTANCE));
    // Armable in GUIDED about 42 s after the connection.
    console
        .until("the position is known", |console| {
            console
                .vehicle(7)
                .is_some_and(|vehicle| vehicle.ready_to_arm())
        })
        .await;
    for line in ["guided", "arm", "takeoff 10", "goto n 20 e 10 up 15", "rtl"] {
        let entry = console.give(line, &[7]);
        console.until_done(entry, 7).await;
    }
    console
        .until("it has landed", |console| {
            console.vehicle(7).is_some_and(|vehicle| !vehicle.armed())
        })
        .await;
    let vehicle = console.vehicle(7).expect("it appeared");
    assert!(vehicle.distance_home_m().is_some_and(|metres| metres < 1.5));
}

/// Starts a SITL that logs from the start.
fn logging(folder: &Path, serial: &str) -> Sitl {
    let parameters = format!("{}LOG_DISARMED 1\n", parameters());
    fs::write(folder.join("copter.parm"), parameters).expect("written");
    let serial = format!("--serial0 {serial} --serial1 none --serial2 none");
    let place = "--model + --home 50.45,30.52,120,0";
    run(folder, INSTANCE + 1, &format!("{place} {serial}"))
}

/// Downloads the vehicle's log; returns its bytes and the explanation in its row.
async fn download(console: &mut Console, folder: &Path) -> (Vec<u8>, String) {
    let begun = Instant::now();
    let order = console.give(&format!("logs download to {}", folder.display()), &[7]);
    console.until_done(order, 7).await;
    let took = begun.elapsed();
    let files = fs::read_dir(folder).expect("a folder").flatten();
    let paths: Vec<PathBuf> = files.map(|file| file.path()).collect();
    let [path] = &paths[..] else {
        panic!("{paths:?}");
    };
    let bytes = fs::read(path).expect("readable");
    let words = console.explanation(order, 7);
    eprintln!("{} bytes in {took:.2?}: {words}", bytes.len());
    (bytes, words)
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn a_log_of_a_real_arducopter_is_the_same_by_files_and_by_messages() {
    let socket = UdpSocket::bind("127.0.0.1:0").expect("a free port");
    let port = socket.local_addr().expect("bound").port();
    drop(socket);
    let tcp = format!("tcp:127.0.0.1:{}", 5760 + 10 * (INSTANCE + 1));
    let udp = format!("udpclient:127.0.0.1:{port}");
    for (serial, address) in [
        ("tcp:0", tcp),
        (udp.as_str(), format!("udpin:127.0.0.1:{port}")),
    ] {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let _sitl = logging(folder.path(), serial);
        let mut console = Console::keeping_logs(folder.path());
        console.connect(&address);
        console.until_known(&[7]).await;
        let log = folder.path().join("logs/00000001.BIN");
        console
            .until("the log has more than a megabyte", |_| {
                fs::metadata(&log).is_ok_and(|file| file.len() > 1_200_000)
            })
            .await;
        let off = console.give("param set LOG_DISARMED 0", &[7]);
        console.until_done(off, 7).await;
        // Logging continues for a while after it is turned off.
        let (mut len, mut since) = (0, Instant::now());
        console
            .until("the log grows no more", |_| {
                let now = fs::metadata(&log).map_or(0, |file| file.len());
                if now != len {
                    (len, since) = (now, Instant::now());
                }
                since.elapsed() > Duration::from_secs(4)
            })
            .await;
        let (bytes, words) = download(&mut console, &folder.path().join("files")).await;
        assert!(
            words.contains("by log messages, checksum verified"),
            "{words}"
        );
        assert!(bytes == fs::read(&log).expect("SITL's own"));
        let off = console.give("param set BRD_OPTIONS 2", &[7]);
        console.until_done(off, 7).await;
        drop(console);
        let mut console = Console::keeping_logs(folder.path());
        console.connect(&address);
        console.until_known(&[7]).await;
        let (again, words) = download(&mut console, &folder.path().join("messages")).await;
        assert!(words.contains("saved by log messages: "), "{words}");
        assert!(again == bytes);
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn files_are_copied_to_and_from_a_real_arducopter() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let _sitl = logging(folder.path(), "tcp:0");
    let mut console = Console::with_files();
    console.connect(&format!("tcp:127.0.0.1:{}", 5760 + 10 * (INSTANCE + 1)));
    console.until_known(&[7]).await;
    for line in [
        "ftp list",
        "ftp list @SYS",
        "ftp list /APM",
        "ftp list @PARAM",
    ] {
        eprintln!("{line}: {:?}", console.carried_out(line, 7).await);
    }
    let own = tempfile::tempdir().expect("a temporary folder");
    to_and_fro(&mut console, 7, own.path()).await;
    let file = own.path().join("param.pck");
    let get = format!(
        "ftp get @PARAM/param.pck?withdefaults=1 to {}",
        file.display()
    );
    eprintln!("{}", console.succeeds(&get, 7).await);
    let bytes = fs::read(&file).expect("it is there");
    let defaults = read_defaults(&bytes).expect("it is whole");
    assert!(defaults.len() > 500, "{}", defaults.len());
    assert!(defaults.contains_key("RTL_ALT"));
}

/// An instance whose serial ports are TCP servers: serial 0, which always accepts unsigned frames,
/// and serial 1, which rejects them once there is a key.
fn with_ports(folder: &Path, instance: u16) -> Sitl {
    fs::write(folder.join("copter.parm"), parameters()).expect("written");
    // Without waiting for a client of serial 0.
    let ports = "--serial0 tcp:0 --serial1 tcp:2";
    let place = "--model quad --home -35.363262,149.165237,584,0";
    run(folder, instance, &format!("{place} {ports}"))
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs SORTIE_ARDUCOPTER"]
async fn a_real_arducopter_proves_its_keys_through_restarts_of_both_sides() {
    let folder = tempfile::tempdir().expect("a folder");
    let keys = tempfile::tempdir().expect("a folder");
    let instance = INSTANCE + 2;
    let address = format!("tcp:127.0.0.1:{}", 5762 + 10 * instance);
    let sitl = with_ports(folder.path(), instance);
    let mut console = signing::start(keys.path(), false).await.console;
    console.connect(&address);
    console.until_known(&[7]).await;
    for (line, mode) in [
        ("signing setup", "guided"),
        ("signing rotate", "loiter"),
        ("signing remove", "guided"),
        ("signing setup", "loiter"),
    ] {
        let begun = Instant::now();
        let words = console.carry_out(line, 7).await;
        eprintln!("{line} in {:.2?}: {words}", begun.elapsed());
        console.carry_out(mode, 7).await;
    }
    drop(console);
    drop(sitl);
    let _sitl = with_ports(folder.path(), instance);
    for (ago, mode) in [(86_400 * 100_000, "guided"), (0, "loiter")] {
        let mut signed = signing::start(keys.path(), true).await;
        signed.set_clock(ago);
        signed.console.connect(&address);
        signed.console.until_known(&[7]).await;
        signed.console.carry_out(mode, 7).await;
        eprintln!("{:?}", signed.console.seals(0));
        assert_eq!(signed.console.seals(0).old, 0);
    }
}
