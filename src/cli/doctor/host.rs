//! Checks of the host: writable folders, and the number of instances that it can carry.

use std::fmt::Write as _;
use std::fs;
use std::io::ErrorKind;
use std::os::unix::fs::{MetadataExt as _, PermissionsExt as _};
use std::path::{Path, PathBuf};

use nix::sys::resource::{Resource, getrlimit};
use nix::unistd::{Gid, Group};

use super::super::settings::CliSettings;
use super::HostFinding;
use super::folder::{FolderUse, folder, shell_word};
use super::mount::network_file_system;
use crate::config::Readers;
use crate::sitl::quoted;
use crate::store::{
    KeyFile, KeyFileFault, PROFILES_FILE, RUNS, SharingFault, other_owner, sharing_fault,
};
use crate::text::Text;

/// The processor use of one idle or flying `ArduCopter` 4.6, in percent of a core, measured with up
/// to 32 of them.
const CORE_PERCENT: f64 = 3.1;
/// The resident memory of one idle or flying `ArduCopter`, in KiB.
const MEMORY_KIB: u64 = 8 * 1024;
/// Files that one instance keeps open in this program: its connection, its listener, its output.
const FILES_EACH: u64 = 4;
/// The maximum number of paths named in a finding.
const MOST_NAMED: usize = 3;
/// Files that this program keeps open without instances.
const FILES_OWN: u64 = 64;

/// The configuration, data and state folders.
pub(super) fn folders(settings: &CliSettings) -> Vec<HostFinding> {
    let Some(folders) = &settings.folders else {
        return vec![HostFinding::fault(
            "folders",
            "no home folder",
            "set HOME, or XDG_CONFIG_HOME, XDG_DATA_HOME and XDG_STATE_HOME",
        )];
    };
    let state = hangar_folder(settings).unwrap_or_else(|| folders.state.clone());
    let mut all = Vec::from([
        folder("config", &folders.config, FolderUse::Files),
        folder("data", &folders.data, FolderUse::Results),
        folder("state", &folders.state, FolderUse::Files),
    ]);
    if !state.starts_with(&folders.state) {
        all.push(folder("hangar folder", &state, FolderUse::Files));
    }
    all
}

pub(super) fn hangar_folder(settings: &CliSettings) -> Option<PathBuf> {
    let set = settings.config.hangar.folder.as_ref().map(PathBuf::from);
    set.or_else(|| Some(settings.folders.as_ref()?.state.join("hangar")))
}

/// Whether the folder of the profiles is safe for a database: on this machine, and not writable by other users.
pub(super) fn database(settings: &CliSettings) -> Vec<HostFinding> {
    let mounts = fs::read_to_string("/proc/self/mountinfo").unwrap_or_default();
    let data = settings.data.path().into_iter();
    data.flat_map(|data| {
        let nearest = data.ancestors().find(|folder| folder.exists());
        // If the folder is a link, its files are on the file system of the link's target.
        let real = nearest.and_then(|folder| folder.canonicalize().ok());
        let there = real.unwrap_or_else(|| data.to_owned());
        let far = on_network(&mounts, data, &there);
        let readers = known_readers(settings);
        let findings = far.into_iter().chain(open_to_others(data));
        findings.chain(readers.and_then(|readers| shared_otherwise(data, readers)))
    })
    .collect()
}

/// The setting `results.readers`; `None` if a fault in a configuration file may have removed it.
fn known_readers(settings: &CliSettings) -> Option<Readers> {
    let is_unset = !settings.sources.is_named("results.readers")
        && !settings.sources.is_of_file("results.readers");
    let is_doubtful = is_unset && settings.has_faulty_configuration();
    (!is_doubtful).then_some(settings.config.results.readers)
}

fn on_network(mounts: &str, data: &Path, there: &Path) -> Option<HostFinding> {
    let kind = network_file_system(mounts, there)?;
    Some(HostFinding::note(
        "profiles",
        format!("{} is on a network folder ({kind})", data.display()),
        "use the profiles from one machine at a time, or choose a folder on this machine: --data, SORTIE_DATA",
    ))
}

/// A finding if other users may write to the folder: they could make links that lead the program's files elsewhere.
fn open_to_others(data: &Path) -> Option<HostFinding> {
    let facts = fs::metadata(data).ok()?;
    let is_open = facts.permissions().mode() & 0o022 != 0;
    is_open.then(|| {
        let name = data.display();
        HostFinding::fault(
            "profiles",
            format!("other users can write to {name}"),
            format!("chmod go-w {}", shell_word(data)),
        )
    })
}

/// A finding if the group's permissions differ from the setting `results.readers`.
fn shared_otherwise(data: &Path, readers: Readers) -> Option<HostFinding> {
    let (name, word) = (data.display(), shell_word(data));
    Some(match sharing_fault(data, readers)? {
        SharingFault::Foreign(paths) => foreign(data, &paths),
        SharingFault::NotShared => HostFinding::fault(
            "profiles",
            format!(
                "results.readers is \"group\", but the group cannot read all results in {name}: a setgid bit or the group's right to read is missing"
            ),
            opening(data),
        ),
        SharingFault::OtherGroup(count) => {
            let group =
                fs::metadata(data).map_or_else(|_| "GROUP".to_owned(), |it| group_name(it.gid()));
            HostFinding::fault(
                "profiles",
                format!(
                    "{count} of the files and folders in {name} do not belong to its group, {group}, which cannot read them"
                ),
                format!("as root: chgrp -R {} {word}", quoted(&group)),
            )
        }
        SharingFault::StillShared => HostFinding::note(
            "profiles",
            format!("results.readers is \"owner\", but the group can still read {name}"),
            format!("chmod -R g-rwxs {word}"),
        ),
    })
}

/// The results of other users, which only they or the superuser can share.
fn foreign(data: &Path, paths: &[PathBuf]) -> HostFinding {
    let named = &paths[..paths.len().min(MOST_NAMED)];
    let shown: Vec<String> = named.iter().map(|it| it.display().to_string()).collect();
    let more = match paths.len() - named.len() {
        0 => String::new(),
        count => format!(" and {count} more"),
    };
    let words: Vec<String> = named.iter().map(|it| shell_word(it)).collect();
    let list = words.join(" ");
    let facts = fs::metadata(data);
    let owner = facts.map_or_else(
        |_| "OWNER:GROUP".to_owned(),
        |it| format!("{}:{}", it.uid(), quoted(&group_name(it.gid()))),
    );
    HostFinding::fault(
        "profiles",
        format!(
            "results.readers is \"group\", but another user owns {}{more} and the group cannot read it",
            shown.join(", ")
        ),
        format!("as root: chown -R {owner} {list}; chmod -R g+rX {list}"),
    )
}

/// The commands that open the results in a data folder to its group. Other files stay closed, such as the signing keys.
fn opening(data: &Path) -> String {
    let facts = fs::metadata(data);
    let group = facts.map_or_else(|_| "GROUP".to_owned(), |it| group_name(it.gid()));
    let (group, folder) = (quoted(&group), shell_word(data));
    let mut commands = format!("as root: chgrp -R {group} {folder}; chmod g+rxs {folder}");
    if data.join(PROFILES_FILE).exists() {
        let _ = write!(commands, "; chmod g+r {folder}/{PROFILES_FILE}*");
    }
    let runs = data.join(RUNS);
    if runs.is_dir() {
        let runs = shell_word(&runs);
        let _ = write!(
            commands,
            "; chmod -R g+rX {runs}; find {runs} -type d -exec chmod g+s {{}} +"
        );
    }
    commands
}

/// The name of a group, or its number if it has none.
fn group_name(id: u32) -> String {
    let known = Group::from_gid(Gid::from_raw(id)).ok().flatten();
    known.map_or_else(|| id.to_string(), |group| group.name)
}

/// Processors, memory and limits, and the number of instances that fit.
pub(super) fn machine() -> Vec<HostFinding> {
    let cores = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let by_cores = (cores as f64 * 100.0 / CORE_PERCENT) as u64;
    let mut all = vec![HostFinding::ok(
        "processors",
        format!("{cores}: room for about {by_cores} SITL ({CORE_PERCENT} % of a core each)"),
    )];
    let text = fs::read_to_string("/proc/meminfo").unwrap_or_default();
    if let Some(free_kib) = available_kib(&text) {
        let (free_mib, fit) = (free_kib / 1024, free_kib / MEMORY_KIB);
        let found = format!("{free_mib} MiB free: room for about {fit} SITL (8 MiB each)");
        all.push(if fit < 4 {
            HostFinding::note("memory", found, "end other programs first")
        } else {
            HostFinding::ok("memory", found)
        });
    }
    all.push(limit(
        "open files",
        Resource::RLIMIT_NOFILE,
        "ulimit -n",
        |files| files.saturating_sub(FILES_OWN) / FILES_EACH,
    ));
    // Each instance has two threads, which count as processes for the limit.
    all.push(limit(
        "processes",
        Resource::RLIMIT_NPROC,
        "ulimit -u",
        |processes| processes / 2,
    ));
    all
}

fn limit(about: &str, what: Resource, command: &str, fit: fn(u64) -> u64) -> HostFinding {
    match getrlimit(what) {
        Ok((_, hard)) if fit(hard) < 32 => HostFinding::note(
            about,
            format!("{hard} at most: room for about {} SITL", fit(hard)),
            format!("raise the limit ({command}) for more"),
        ),
        Ok((_, hard)) if hard == nix::sys::resource::RLIM_INFINITY => {
            HostFinding::ok(about, "no limit")
        }
        Ok((_, hard)) => HostFinding::ok(
            about,
            format!("{hard} at most: room for about {} SITL", fit(hard)),
        ),
        Err(error) => HostFinding::note(about, format!("unknown: {error}"), "no action is needed"),
    }
}

/// The memory still available to programs, in KiB: `MemAvailable` of `/proc/meminfo`.
fn available_kib(text: &str) -> Option<u64> {
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    line.split_ascii_whitespace().next()?.parse().ok()
}

/// Whether the signing keys can be used; `None` without any.
pub(super) fn keys(settings: &CliSettings) -> Option<HostFinding> {
    let data = settings.data.path()?;
    let file = KeyFile::path_within(data);
    let (path, word) = (file.display(), shell_word(&file));
    let about = "signing keys";
    match KeyFile::look(data) {
        Ok(None) => None,
        Ok(Some(keys)) => {
            let count = keys.count();
            Some(HostFinding::ok(about, format!("{path}: {count} in use")))
        }
        Err(fault @ KeyFileFault::Readable { .. }) => Some(HostFinding::fault(
            about,
            Text::from(&fault).to_string(),
            format!("chmod 600 {word}, then `signing rotate` for every vehicle"),
        )),
        Err(KeyFileFault::Io { error, .. }) if error.kind() == ErrorKind::PermissionDenied => {
            let owner = other_owner(data).map_or_else(String::new, |it| {
                format!(": {} belongs to {it}", data.display())
            });
            Some(HostFinding::note(
                about,
                format!("no permission to read {path}{owner}"),
                "choose your own data folder with --data or SORTIE_DATA",
            ))
        }
        Err(fault) => Some(HostFinding::fault(
            about,
            Text::from(&fault).to_string(),
            format!("restore {path} from a copy: a lost key cannot be recovered over MAVLink"),
        )),
    }
}

/// Whether only its owner can read the token of the services.
pub(super) fn token(settings: &CliSettings) -> Option<HostFinding> {
    let set = settings
        .config
        .hangar
        .token_file
        .as_ref()
        .map(PathBuf::from);
    let is_named = set.is_some();
    let path = set.or_else(|| Some(settings.folders.as_ref()?.state.join("hangar-token")))?;
    let name = path.display();
    let about = "hangar token";
    Some(match fs::metadata(&path) {
        Err(_) if !is_named => HostFinding::ok(
            about,
            format!("{name} does not exist yet: the service creates it"),
        ),
        Err(error) => HostFinding::note(
            about,
            format!("{name}: {error}"),
            "start `sortie hangar`, which creates it",
        ),
        Ok(facts) if facts.permissions().mode() & 0o077 != 0 => HostFinding::fault(
            about,
            format!("others can read {name}, and start and stop vehicles with it"),
            format!("rm {}: a new one is created", shell_word(&path)),
        ),
        Ok(facts) if facts.uid() != nix::unistd::geteuid().as_raw() => HostFinding::fault(
            about,
            format!("{name} belongs to another user"),
            "name another with the setting hangar.token_file",
        ),
        Ok(_) => HostFinding::ok(about, format!("{name}, readable by you alone")),
    })
}

#[cfg(test)]
mod tests {
    use super::super::CheckResult;
    use super::*;

    #[test]
    fn memory_is_read() {
        let text = "MemTotal: 100 kB\nMemAvailable:   81920 kB\n";
        assert_eq!(available_kib(text), Some(81_920));
        assert_eq!(available_kib(""), None);
    }

    #[test]
    fn a_database_on_a_network_folder_or_one_that_others_write_to_is_noticed() {
        let data = tempfile::tempdir().expect("a temporary folder");
        let mounts = "22 1 0:35 / / rw - nfs4 server:/ rw\n";
        let far = on_network(mounts, data.path(), data.path()).expect("noticed");
        assert_eq!(far.verdict, CheckResult::Note);
        assert!(far.found.ends_with("is on a network folder (nfs4)"));
        assert_eq!(on_network("", data.path(), data.path()), None);
        assert_eq!(open_to_others(data.path()), None);
        let open = fs::Permissions::from_mode(0o777);
        fs::set_permissions(data.path(), open).expect("ours");
        let found = open_to_others(data.path()).expect("noticed");
        assert_eq!(found.verdict, CheckResult::Fault);
    }

    #[test]
    fn results_of_another_user_are_named_with_the_command() {
        let data = tempfile::tempdir().expect("a temporary folder");
        let facts = fs::metadata(data.path()).expect("ours");
        let owner = format!("{}:{}", facts.uid(), group_name(facts.gid()));
        let paths = ["a", "b c", "d", "e"].map(|name| Path::new("/data").join(name));
        let found = foreign(data.path(), &paths);
        assert!(
            found
                .found
                .contains("another user owns /data/a, /data/b c, /data/d and 1 more"),
            "{}",
            found.found
        );
        let list = "/data/a '/data/b c' /data/d";
        let command = format!("as root: chown -R {owner} {list}; chmod -R g+rX {list}");
        assert_eq!(found.mend, Some(command));
    }

    #[test]
    fn a_path_in_a_command_is_quoted() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let data = folder.path().join("my results; old");
        fs::create_dir(&data).expect("ours");
        let quoted = format!("'{}'", data.display());
        let found = shared_otherwise(&data, Readers::Group).expect("noticed");
        let facts = fs::metadata(&data).expect("ours");
        let group = group_name(facts.gid());
        let command = format!("as root: chgrp -R {group} {quoted}; chmod g+rxs {quoted}");
        assert_eq!(found.mend, Some(command));
        fs::set_permissions(&data, fs::Permissions::from_mode(0o777)).expect("ours");
        let found = open_to_others(&data).expect("noticed");
        assert_eq!(found.mend, Some(format!("chmod go-w {quoted}")));
    }

    #[test]
    fn a_folder_that_is_shared_otherwise_than_set_is_noticed_with_the_command() {
        let data = tempfile::tempdir().expect("a temporary folder");
        let name = data.path().display();
        assert!(shared_otherwise(data.path(), Readers::Group).is_some());
        assert!(crate::store::share_with_group(data.path()).is_empty());
        assert_eq!(shared_otherwise(data.path(), Readers::Group), None);
        let found = shared_otherwise(data.path(), Readers::Owner).expect("noticed");
        assert_eq!(found.mend, Some(format!("chmod -R g-rwxs {name}")));
    }

    #[test]
    fn the_command_for_a_folder_without_its_setgid_bit_opens_all_results_and_nothing_else() {
        let home = tempfile::tempdir().expect("a temporary folder");
        let data = home.path().join("my data");
        let mode = |name: &str| {
            let facts = fs::metadata(data.join(name)).expect("there");
            facts.permissions().mode() & 0o7777
        };
        fs::create_dir_all(data.join("runs/old")).expect("ours");
        let results = [
            "profiles.sqlite",
            "profiles.sqlite.backup",
            "profiles.sqlite.lock",
            "runs/a",
            "runs/old/b",
        ];
        for name in results.into_iter().chain(["signing.toml"]) {
            let path = data.join(name);
            fs::write(&path, "").expect("ours");
            fs::set_permissions(&path, fs::Permissions::from_mode(0o600)).expect("ours");
        }
        fs::set_permissions(&data, fs::Permissions::from_mode(0o750)).expect("ours");
        let found = shared_otherwise(&data, Readers::Group).expect("noticed");
        let advice = found.mend.expect("advice");
        let command = advice.strip_prefix("as root: ").expect("for root");
        let done = std::process::Command::new("sh")
            .args(["-c", command])
            .status();
        assert!(done.expect("a shell").success(), "{command}");
        assert_eq!(shared_otherwise(&data, Readers::Group), None, "{command}");
        for name in results {
            assert_eq!(mode(name), 0o640, "{name}");
        }
        assert_eq!(mode("signing.toml"), 0o600);
        assert_eq!(mode("runs/old") & 0o2050, 0o2050);
    }
}
