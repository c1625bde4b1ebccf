//! The blocks of the chapter on studies that start its parts on more machines, run as they stand but for fewer variants.
//! Skipped where the programs that they call are not installed, or do not start.

use super::blocks::{blocks, place};
use super::text;
use std::fs::{self, File};
use std::net::TcpListener;
use std::path::Path;
use std::process::{Child, Command, Output};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// Variants of the chapter, and those that are run.
const VARIANTS: [&str; 2] = [":1000", ":16"];

/// The block of the chapter that has this word, with fewer variants.
fn block(word: &str) -> String {
    let all = blocks(text("studies"));
    let (_, body) = all.iter().find(|(_, body)| body.contains(word)).unwrap_or_else(|| panic!("no block has {word}"));
    assert!(body.contains(VARIANTS[0]), "{body}");
    body.replace(VARIANTS[0], VARIANTS[1])
}

/// A command that finds the program, in a folder.
fn command(place: &Path, words: &[&str]) -> Command {
    let program = Path::new(env!("CARGO_BIN_EXE_holonom")).parent().unwrap();
    let folders = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut command = Command::new(words[0]);
    command.args(&words[1..]).current_dir(place).env("PATH", folders);
    command
}

fn done(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().unwrap();
    let [said, errors] = [stdout, stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    assert!(status.success(), "{command:?}: {said}{errors}");
    said
}

/// True if all programs are there; says which is not.
fn are_installed(programs: &[&str]) -> bool {
    let is_missing =
        |program: &&&str| !Command::new("which").arg(program).output().is_ok_and(|found| found.status.success());
    let missing = programs.iter().find(is_missing);
    missing.inspect(|program| eprintln!("skipped: {program} is not installed")).is_none()
}

/// Compares the parts that were joined with the whole study, byte by byte.
fn compare(place: &Path) {
    let vary = format!("c_strut=500..4000{}", VARIANTS[1]);
    done(&mut command(place, &["holonom", "study", "models/quarter_car.json", "--vary", &vary, "-o", "out/whole"]));
    for name in ["study.csv", "study.npz", "study.svg"] {
        let [joined, whole] =
            ["joined", "whole"].map(|folder| fs::read(place.join("out").join(folder).join(name)).unwrap());
        assert!(joined == whole, "{name} differs");
    }
}

#[test]
fn parallel_runs_the_parts() {
    // Another program has this name, too.
    let version = Command::new("parallel").arg("--version").output();
    if !version.is_ok_and(|found| String::from_utf8_lossy(&found.stdout).starts_with("GNU parallel")) {
        return eprintln!("skipped: GNU parallel is not installed");
    }
    let place = place();
    done(&mut command(place.path(), &["sh", "-ec", &block("| parallel")]));
    compare(place.path());
}

#[test]
fn slurm_runs_the_parts() {
    if !are_installed(&["munged", "slurmctld", "slurmd", "sbatch", "srun", "sinfo"]) {
        return;
    }
    let cluster = match Cluster::start() {
        Ok(cluster) => cluster,
        Err(problem) => return eprintln!("skipped: {problem}"),
    };
    let place = place();
    fs::write(place.path().join("parts.sh"), block("#SBATCH")).unwrap();
    let said =
        done(command(place.path(), &["sbatch", "--wait", "parts.sh"]).env("SLURM_CONF", cluster.path("slurm.conf")));
    assert!(said.starts_with("Submitted batch job"), "{said}");
    let parallel = block("| parallel");
    let merge = parallel.lines().find(|line| line.contains("--merge")).unwrap();
    done(&mut command(place.path(), &["sh", "-c", merge]));
    compare(place.path());
}

/// A Slurm cluster of this machine alone, run by the present user.
struct Cluster {
    place: TempDir,
    daemons: Vec<Child>,
}

/// A daemon that has not answered by then does not run here.
const PATIENCE: Duration = Duration::from_secs(30);

impl Cluster {
    fn start() -> Result<Cluster, String> {
        let mut cluster = Cluster { place: tempfile::tempdir().unwrap(), daemons: Vec::new() };
        cluster.configure();
        let option = |name: &str, file: &str| format!("--{name}={}", cluster.path(file));
        let [key, socket] = [option("key-file", "munge.key"), option("socket", "munge.sock")];
        let [id, seed] = [option("pid-file", "munge.pid"), option("seed-file", "munge.seed")];
        // The folder is closed to other users, which munged takes for a mistake unless it is forced.
        cluster.spawn(&["munged", "--foreground", "--force", &key, &socket, &id, &seed]);
        cluster.until_ready("munged", |cluster| Path::new(&cluster.path("munge.sock")).exists())?;
        let configuration = cluster.path("slurm.conf");
        cluster.spawn(&["slurmctld", "-D", "-i", "-f", &configuration]);
        cluster.spawn(&["slurmd", "-D", "-f", &configuration]);
        cluster.until_ready("slurmd", |cluster| {
            let mut nodes = Command::new("sinfo");
            let output = nodes.args(["-h", "-o", "%T"]).env("SLURM_CONF", cluster.path("slurm.conf")).output();
            output.is_ok_and(|found| found.stdout == b"idle\n")
        })?;
        Ok(cluster)
    }

    fn path(&self, name: &str) -> String {
        self.place.path().join(name).display().to_string()
    }

    /// Writes the key and the configuration: one node that says that it has cores for all parts at once.
    fn configure(&self) {
        let key = self.path("munge.key");
        fs::write(&key, [42; 64]).unwrap();
        done(Command::new("chmod").args(["600", &key]));
        let [node, user] = [vec!["uname", "-n"], vec!["id", "-un"]]
            .map(|words| done(Command::new(words[0]).arg(words[1])).trim().to_string());
        let port = || TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().port();
        let [folder, socket, controller_id, daemon_id] =
            ["", "munge.sock", "slurmctld.pid", "slurmd.pid"].map(|name| self.path(name));
        let text = format!(
            "ClusterName=one\nSlurmctldHost={node}(127.0.0.1)\nSlurmctldPort={}\nSlurmdPort={}\n\
             SlurmUser={user}\nSlurmdUser={user}\nAuthInfo=socket={socket}\n\
             StateSaveLocation={folder}\nSlurmdSpoolDir={folder}\n\
             SlurmctldPidFile={controller_id}\nSlurmdPidFile={daemon_id}\n\
             ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nMpiDefault=none\n\
             SelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\nSlurmdParameters=config_overrides\n\
             SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0,bf_interval=1\n\
             NodeName={node} NodeAddr=127.0.0.1 CPUs=32 State=UNKNOWN\n\
             PartitionName=all Nodes=ALL Default=YES State=UP\n",
            port(),
            port()
        );
        fs::write(self.path("slurm.conf"), text).unwrap();
    }

    fn spawn(&mut self, words: &[&str]) {
        let log = File::create(self.path(&format!("{}.log", words[0]))).unwrap();
        let mut daemon = command(self.place.path(), words);
        self.daemons.push(daemon.stdout(log.try_clone().unwrap()).stderr(log).spawn().unwrap());
    }

    /// Waits until a daemon answers; else returns the end of what it said.
    fn until_ready(&self, daemon: &str, is_ready: impl Fn(&Cluster) -> bool) -> Result<(), String> {
        let clock = Instant::now();
        while clock.elapsed() < PATIENCE {
            if is_ready(self) {
                return Ok(());
            }
            std::thread::sleep(Duration::from_millis(100));
        }
        let said = fs::read_to_string(self.path(&format!("{daemon}.log"))).unwrap();
        Err(format!("{daemon} does not run here: {}", said.lines().last().unwrap_or("it says nothing")))
    }
}

impl Drop for Cluster {
    fn drop(&mut self) {
        for daemon in self.daemons.iter_mut().rev() {
            let _ = daemon.kill();
            let _ = daemon.wait();
        }
    }
}
