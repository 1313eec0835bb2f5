//! The program loses nothing: each way to lose a file that we know of is tried here, with the program as it is run.
#![cfg(unix)]

use std::fs::{self, File};
use std::io::{Read, Write};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const SHUTTER: &str = env!("CARGO_BIN_EXE_shutter");
const SCENE: &str = "open_start = 0\nopen_end = 0.25\nclose_start = 0.75\nclose_end = 1\n\
                     triggers = 7\ntimer_hz = 1000\nmin_gap = 0.1\nset_up = 'emulated'\n";

/// An empty folder with a scene and a trace of straight ramps, in which the program is run.
struct Folder(PathBuf);

/// How a run ended: its code, or none where it was killed; standard output, standard error.
type Ended = (Option<i32>, String, String);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("outputs").join(name);
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        let folder = Self(folder);
        folder.write("scene.toml", SCENE);
        folder.write("trace.csv", &trace(1.0));
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    fn text(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn names(&self) -> Vec<String> {
        let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name();
        let names = fs::read_dir(&self.0).unwrap().map(name);
        let mut names: Vec<_> = names.map(|name| name.into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Runs the program with these arguments, by a line of a shell with `$shutter` in it.
    fn shell(&self, line: &str) -> Ended {
        let mut sh = Command::new("sh");
        let run =
            sh.args(["-c", line]).env("shutter", SHUTTER).current_dir(&self.0).output().unwrap();
        let [out, err] = [run.stdout, run.stderr].map(|text| String::from_utf8(text).unwrap());
        (run.status.code(), out, err)
    }

    fn run(&self, args: &str) -> Ended {
        self.shell(&format!("exec \"$shutter\" {args}"))
    }

    /// The run is refused for this reason, and all files are as they were.
    fn refuses(&self, line: &str, reason: &str) {
        let before = self.all();
        let (code, _, err) = self.shell(line);
        assert_eq!(code, Some(2), "{line}: {err}");
        assert!(err.contains(reason), "{line}: {err}");
        assert_eq!(self.all(), before, "{line}");
    }

    /// All files, links and what they hold.
    fn all(&self) -> Vec<(String, Option<PathBuf>, Option<Vec<u8>>)> {
        let file = |name: String| {
            let path = self.path(&name);
            let text = path.is_file().then(|| fs::read(&path).unwrap());
            (name, fs::read_link(&path).ok(), text)
        };
        self.names().into_iter().map(file).collect()
    }
}

/// Opens from 2 to 4 ms and closes from 7 to 9, or so many times later.
fn trace(slower: f64) -> String {
    let row = |i: u32| {
        let t = 0.01 * f64::from(i);
        let noise = f64::from(i.wrapping_mul(2_654_435_761) >> 16) / 65_536.0 - 0.5;
        let light = (t - 2.0).min(9.0 - t).clamp(0.0, 2.0) / 2.0;
        format!("{:.4},{:.5}\n", slower * t, 0.1 + 2.0 * light + 0.03 * noise)
    };
    String::from("time_ms,v\n") + &(0..1200).map(row).collect::<String>()
}

#[test]
fn an_output_that_is_an_input_is_refused_by_any_name() {
    let folder = Folder::new("inputs");
    symlink("trace.csv", folder.path("link.toml")).unwrap();
    symlink(&folder.0, folder.path("again")).unwrap();
    fs::hard_link(folder.path("trace.csv"), folder.path("hard.toml")).unwrap();
    fs::hard_link(folder.path("scene.toml"), folder.path("hard.svg")).unwrap();
    for out in [
        "trace.csv",
        "./trace.csv",
        "link.toml",
        "hard.toml",
        "again/trace.csv",
        "../inputs/trace.csv",
    ] {
        for force in ["", " --force"] {
            folder
                .refuses(&format!("$shutter fit trace.csv --out {out}{force}"), "it is the input");
        }
    }
    folder.refuses("$shutter fit link.toml --out trace.csv", "it is the input");
    folder.refuses("$shutter plan scene.toml --out hard.svg --force", "it is the input");
    folder.refuses("$shutter plan scene.toml --emit c --to scene.toml --force", "it is the input");
    // Traces that are called as their scenes would be.
    folder.write("a.toml", &trace(1.0));
    folder.write("b.toml", &trace(2.0));
    folder.refuses("$shutter fit a.toml b.toml --out . --force", "it is the input");
    folder.refuses("$shutter plan scene.toml --emit rust >> scene.toml", "standard output");
    folder.refuses("$shutter fit - --out trace.csv --force < trace.csv", "standard input");
}

#[test]
fn two_outputs_of_one_file_are_refused() {
    let folder = Folder::new("twice");
    symlink("new.svg", folder.path("link.svg")).unwrap();
    fs::create_dir(folder.path("sub")).unwrap();
    folder.write("sub/trace.csv", &trace(2.0));
    folder.write("old.svg", "old");
    fs::hard_link(folder.path("old.svg"), folder.path("hard.svg")).unwrap();
    for (line, reason) in [
        ("plan --out new.svg --set-ups new.svg", "two outputs"),
        ("plan --out new.svg --set-ups sub/../new.svg", "two outputs"),
        ("plan --out new.svg --set-ups link.svg", "two outputs"),
        ("plan --force --out old.svg --set-ups hard.svg", "two outputs"),
        ("plan --out new.svg --emit c --to new.svg", "two outputs"),
        ("fit trace.csv --out new.svg --picture new.svg", "two outputs"),
        ("fit trace.csv sub/trace.csv --out .", "two outputs"),
        ("plan --out - --emit c --to -", "standard output"),
        ("plan --out - --emit c", "standard output"),
        ("fit trace.csv --picture - --report json", "standard output"),
        ("fit - -", "standard input"),
        ("plan --force --out old.svg >> old.svg", "standard output"),
    ] {
        folder.refuses(&format!("$shutter {line}"), reason);
    }
}

#[test]
fn a_file_of_something_else_needs_force() {
    let folder = Folder::new("force");
    folder.write("notes", "what I measured\n");
    symlink("notes", folder.path("link.svg")).unwrap();
    for line in [
        "fit trace.csv --out notes",
        "plan --out link.svg",
        "plan --emit csv --to notes",
        "fit trace.csv --picture link.svg",
    ] {
        folder.refuses(&format!("$shutter {line}"), "--force");
    }
    assert_eq!(folder.run("plan --emit csv --to notes --force").0, Some(0));
    assert!(folder.text("notes").starts_with("scene,index,"));
    assert!(folder.path("link.svg").is_symlink());
    // What it wrote is replaced while nobody has changed it: by its mark, or by the same bytes where it has none.
    for form in ["rust", "c", "csv", "json"] {
        let line = format!("plan --emit {form} --to made.{form}");
        for _ in 0..2 {
            let (code, _, err) = folder.run(&line);
            assert_eq!((code, err), (Some(0), format!("wrote made.{form}\n")));
        }
        let (has_mark, other) = (matches!(form, "rust" | "c"), format!("{line} --triggers 5"));
        match has_mark {
            true => assert_eq!(folder.run(&other).0, Some(0), "{form}"),
            false => folder.refuses(&format!("$shutter {other}"), "a table does not tell whose"),
        }
        let made = folder.text(&format!("made.{form}"));
        folder.write(&format!("made.{form}"), &format!("{made}\n"));
        let reason = if has_mark { "you have changed it since" } else { "--force" };
        folder.refuses(&format!("$shutter {line}"), reason);
        let (code, _, err) = folder.run(&format!("{line} --force"));
        assert_eq!((code, err), (Some(0), format!("wrote made.{form}\n")));
        assert_ne!(folder.text(&format!("made.{form}")), made + "\n");
    }
    for _ in 0..2 {
        assert_eq!(folder.run("plan --out made.svg --set-ups both.svg").0, Some(0));
    }
    assert_eq!(folder.run("fit trace.csv --picture made.svg").0, Some(0));
    folder.write("made.svg", &folder.text("made.svg").replace("<svg ", "<svg  "));
    folder.refuses("$shutter fit trace.csv --picture made.svg", "you have changed it since");
    // A remark beside the mark is its user's, and a scene holds what its user wrote whether or not its mark does.
    let made = folder.text("made.rust");
    folder.write("made.rust", &made.replacen('\n', " for board 7\n", 1));
    folder.refuses("$shutter plan --emit rust --to made.rust", "--force");
    assert_eq!(folder.run("fit trace.csv --out leaf.toml").0, Some(0));
    folder.refuses("$shutter plan --emit rust --to leaf.toml", "--force");
}

/// What cannot be written is told before a trace is even read; what fails after the fit leaves its report.
#[test]
fn a_fit_is_not_lost_with_its_files() {
    let folder = Folder::new("late");
    folder.write("notes", "mine\n");
    symlink("notes", folder.path("notes.svg")).unwrap();
    for (line, reason) in [
        ("fit none.csv --out notes", "notes: it holds no scene that a fit wrote"),
        ("fit none.csv --picture notes.svg", "notes.svg: it holds something else"),
        ("fit none.csv --out none/leaf.toml", "its folder is not there"),
        ("fit none.csv --out ok.toml --picture none/leaf.svg", "its folder is not there"),
    ] {
        folder.refuses(&format!("$shutter {line}"), reason);
    }
    assert_eq!(folder.run("fit trace.csv --out leaf.toml").0, Some(0));
    let text = folder.text("leaf.toml").replace("min_gap = 0 ", "min_gap = 9 ");
    folder.write("leaf.toml", &text);
    let (code, out, err) = folder.run("fit trace.csv --out leaf.toml");
    assert!(code == Some(2) && err.contains("with what it keeps"), "{err}");
    assert!(out.contains("\nexposure     5.00"), "{out}");
    assert_eq!(folder.text("leaf.toml"), text);
    // Five nanoseconds are too short for sixteen triggers.
    folder.write("ns.csv", &trace(1.0).replace("time_ms", "time_ns"));
    let (code, out, err) = folder.run("fit ns.csv --out ns.toml");
    assert!(code == Some(2) && err.contains("; --triggers says how many"), "{err}");
    assert!(out.contains("\nexposure     5.00") && !folder.path("ns.toml").exists(), "{out}");
    assert_eq!(folder.run("fit ns.csv --out ns.toml --triggers 4").0, Some(0));
}

#[test]
fn links_are_written_through_and_other_names_keep_what_they_had() {
    let folder = Folder::new("links");
    fs::create_dir(folder.path("far")).unwrap();
    symlink("far/new.svg", folder.path("link.svg")).unwrap();
    symlink("link.svg", folder.path("twice.svg")).unwrap();
    assert_eq!(folder.run("plan --out twice.svg").0, Some(0));
    assert!(folder.path("link.svg").is_symlink() && folder.path("twice.svg").is_symlink());
    assert!(folder.text("far/new.svg").contains("\n<svg "));
    // The mode stays, and a new file's is that of any new file.
    fs::set_permissions(folder.path("far/new.svg"), PermissionsExt::from_mode(0o604)).unwrap();
    fs::hard_link(folder.path("far/new.svg"), folder.path("other.svg")).unwrap();
    let older = folder.text("other.svg");
    assert_eq!(
        folder
            .shell(
                "umask 027; $shutter plan --triggers 3 --out link.svg --set-ups fresh.svg --force"
            )
            .0,
        Some(0)
    );
    let mode = |name: &str| fs::metadata(folder.path(name)).unwrap().permissions().mode() & 0o777;
    assert_eq!((mode("far/new.svg"), mode("fresh.svg")), (0o604, 0o640));
    assert!(folder.text("far/new.svg") != older && folder.text("other.svg") == older);
    assert!(folder.path("link.svg").is_symlink());
    symlink("round.svg", folder.path("round.svg")).unwrap();
    folder.refuses("$shutter plan --out round.svg", "round.svg: ");
}

#[test]
fn devices_and_pipes_are_written_to() {
    let folder = Folder::new("streams");
    assert_eq!(folder.run("plan --out /dev/null --set-ups /dev/null").0, Some(0));
    assert_eq!(folder.run("plan --emit csv --to /dev/stdout").1, folder.run("plan --emit csv").1);
    let (code, out, err) =
        folder.shell("mkfifo pipe.svg; cat pipe.svg & $shutter plan --out pipe.svg > text; wait");
    assert!(code == Some(0) && out.contains("\n<svg ") && out.ends_with("</svg>\n"), "{err}");
    assert!(folder.text("text").contains("exposure"));
    let (code, out, _) = folder.shell(
        "$shutter fit trace.csv --out - | $shutter plan - --set-up emulated --timer-hz 1MHz --emit csv --to -",
    );
    assert!(code == Some(0) && out.starts_with("scene,index,u,"), "{out}");
    let (code, out, _) = folder.shell("$shutter fit - --report json < trace.csv");
    assert!(code == Some(0) && out.contains("\"trace\": \"standard input\""), "{out}");
    let (code, out, _) = folder.run("plan --out -");
    assert!(code == Some(0) && out.contains("\n<svg ") && out.ends_with("</svg>\n"));
}

/// A file whose writing fails at any block leaves the old ones and no other: here a limit is in place of a full disk.
#[test]
fn a_full_disk_leaves_the_old_files() {
    let folder = Folder::new("full");
    assert_eq!(folder.run("plan --out a.svg --set-ups b.svg --emit c --to c.h").0, Some(0));
    let line = "plan scene.toml --out a.svg --set-ups b.svg --emit c --to c.h --force";
    let mut refused = 0;
    for blocks in (0..200).step_by(5) {
        let before = folder.all();
        let (code, _, err) =
            folder.shell(&format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$shutter\" {line}"));
        if code == Some(0) {
            break;
        }
        assert!(code == Some(2) && err.contains("File too large"), "{blocks}: {code:?} {err}");
        assert_eq!(folder.all(), before, "{blocks}");
        refused += 1;
    }
    assert!(refused > 3, "{refused}");
    // A full device, standard output as well: then no file is new either.
    for line in ["plan --out new.svg --emit c --to /dev/full", "plan --out new.svg > /dev/full"] {
        folder.refuses(&format!("$shutter {line}"), "No space left");
    }
}

/// Whenever it is killed while it writes, each file is the old one or the new one, whole.
#[test]
fn a_kill_leaves_whole_files() {
    let folder = Folder::new("killed");
    let [old, new] = [3, 4].map(|n| {
        assert_eq!(
            folder.run(&format!("plan --triggers {n} --out a.svg --emit c --to c.h --force")).0,
            Some(0)
        );
        (folder.text("a.svg"), folder.text("c.h"))
    });
    let (mut killed, mut blocks) = (0, 0);
    loop {
        folder.write("a.svg", &old.0);
        folder.write("c.h", &old.1);
        // Beyond the limit a write is a signal, which ends the program where it stands.
        let (code, _, _) = folder.shell(&format!(
            "ulimit -c 0; ulimit -f {blocks}; exec \"$shutter\" plan --triggers 4 --out a.svg --emit c --to c.h --force"
        ));
        let files = (folder.text("a.svg"), folder.text("c.h"));
        if code == Some(0) {
            assert!(files == new);
            break;
        }
        assert!(code.is_none() && files == old, "{blocks}: {code:?}");
        (killed, blocks) = (killed + 1, blocks + 7);
    }
    assert!(killed > 3, "{killed}");
}

#[test]
fn two_runs_at_once_leave_one_of_theirs() {
    let folder = Folder::new("race");
    let whole = [3, 4].map(|n| {
        folder.run(&format!("plan --triggers {n} --out {n}.svg"));
        folder.text(&format!("{n}.svg"))
    });
    for _ in 0..10 {
        let _ = fs::remove_file(folder.path("new.svg"));
        let runs = [3, 4, 3, 4].map(|n| {
            let mut shutter = Command::new(SHUTTER);
            let args = ["plan", "--triggers", &n.to_string(), "--out", "new.svg"].map(String::from);
            let run = shutter
                .args(args)
                .current_dir(&folder.0)
                .stdout(Stdio::null())
                .stderr(Stdio::null());
            run.spawn().unwrap()
        });
        let codes = runs.map(|mut run| run.wait().unwrap().code());
        assert!(codes.contains(&Some(0)), "{codes:?}");
        assert!(whole.contains(&folder.text("new.svg")));
    }
    assert_eq!(folder.names().len(), 5, "{:?}", folder.names());
}

/// What a user saves while a fit is under way is not replaced.
#[test]
fn a_file_that_changes_meanwhile_is_kept() {
    let folder = Folder::new("meanwhile");
    assert_eq!(folder.run("fit trace.csv --out old.toml").0, Some(0));
    for out in ["old.toml", "new.toml"] {
        let line = format!(
            "mkfifo {out}.in; $shutter fit - --out {out} < {out}.in & exec 3> {out}.in; sleep 0.5\n\
             echo '# by hand' >> {out}; cat trace.csv >&3; exec 3>&-; wait $!"
        );
        let (code, _, err) = folder.shell(&line);
        assert!(
            code == Some(2) && err.contains("it has changed meanwhile"),
            "{out}: {code:?} {err}"
        );
        assert!(folder.text(out).ends_with("# by hand\n"));
    }
    assert!(!folder.names().iter().any(|name| name.starts_with(".shutter")));
}

#[test]
fn what_cannot_be_written_leaves_nothing() {
    let folder = Folder::new("refused");
    fs::create_dir(folder.path("taken.svg")).unwrap();
    folder.refuses("$shutter plan --set-ups ok.svg --out taken.svg", "it is a folder");
    folder.refuses("$shutter plan --set-ups ok.svg --out none/new.svg", "its folder is not there");
    folder.refuses(
        "$shutter fit trace.csv --picture ok.svg --out none/leaf.toml",
        "its folder is not there",
    );
    // A failed plan, and a form for which the scene lacks something.
    folder.write("leaf.h", "/* old */\n");
    folder
        .refuses("$shutter plan scene.toml --triggers 8 --emit c --to leaf.h --force", "triggers");
    folder.write("bare.toml", &SCENE.replace("set_up", "# set_up"));
    folder.refuses(
        "$shutter plan bare.toml --out ok.svg --emit c --to leaf.h --force",
        "bare.toml: hardware needs",
    );
    // Whoever made it read-only does not want it replaced, and root is no exception.
    fs::set_permissions(folder.path("leaf.h"), PermissionsExt::from_mode(0o444)).unwrap();
    folder.refuses("$shutter plan --emit c --to leaf.h --force", "it is read-only");
    let locked = folder.path("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, PermissionsExt::from_mode(0o555)).unwrap();
    // Root may write there.
    if File::create(locked.join("probe")).is_err() {
        folder.refuses("$shutter plan --set-ups ok.svg --out locked/new.svg", "permission denied");
    }
    fs::set_permissions(&locked, PermissionsExt::from_mode(0o755)).unwrap();
}

#[test]
fn a_new_fit_keeps_what_a_user_wrote() {
    let folder = Folder::new("kept");
    let wrote = "wrote leaf.toml\nnext: write set_up, timer_hz, sync_falls into the scene, then \
                 shutter plan leaf.toml --emit rust --to leaf.rs\n";
    let (code, _, err) = folder.run("fit trace.csv --out leaf.toml --sync 0");
    assert_eq!((code, err.as_str()), (Some(0), wrote));
    let first = folder.text("leaf.toml");
    // Of its own it keeps nothing, and piles nothing up.
    let (code, _, err) = folder.run("fit trace.csv --out leaf.toml --sync 0");
    assert_eq!((code, err.as_str(), folder.text("leaf.toml")), (Some(0), wrote, first.clone()));
    let edited = first
        .replace("# timer_hz = ... # your timer's rate, in Hz", "timer_hz = 84_000_000 # TIM2")
        .replace("# sync_falls = ... # true, or", "sync_falls = false # not true, nor")
        .replace("# set_up = \"in_path\" #", "set_up = \"in_path\" #")
        .replace("min_gap = 0 ", "min_gap = 0.1 ")
        .replace("triggers = 16", "# as many as the LED takes\ntriggers = 5")
        .replace("open_start = ", "duty = 0.3\n# by the scope\nopen_start = ")
        + "# the end\n";
    folder.write("leaf.toml", &edited);
    folder.write("slow.csv", &trace(2.0));
    let (code, _, err) = folder.run("fit slow.csv --out leaf.toml --nominal 1/125");
    assert_eq!(code, Some(0), "{err}");
    for kept in
        ["timer_hz = 84000000", "min_gap = 0.1", "duty = 0.3", "delay = 2.0", "in_path", "comments"]
    {
        assert!(err.contains(kept), "{kept}: {err}");
    }
    let text = folder.text("leaf.toml");
    for line in [
        "timer_hz = 84_000_000 # TIM2",
        "# as many as the LED takes",
        "triggers = 5",
        "# by the scope",
        "duty = 0.3",
        "nominal = 8",
    ] {
        assert!(text.lines().any(|it| it == line), "{line}\n{text}");
    }
    assert!(
        text.contains(" holds\n# Fitted to slow.csv") && text.contains("# the end\n"),
        "{text}"
    );
    assert!(!text.contains("trace.csv") && !text.contains("# delay = ?"), "{text}");
    // What the user has answered is asked no more, and kept.
    assert!(text.contains("\nset_up = \"in_path\"") && !text.contains("# set_up"), "{text}");
    assert!(text.contains("\nsync_falls = false") && !text.contains("# sync_falls"), "{text}");
    assert!(!text.contains("# timer_hz"), "{text}");
    assert!(err.ends_with("\nnext: shutter plan leaf.toml --emit rust --to leaf.rs\n"), "{err}");
    assert!(text.contains("\nopen_start = 4.0") && text.contains("± "), "{text}");
    let (code, _, err) = folder.run("fit slow.csv --out leaf.toml --nominal 1/100 --sync 1ms");
    assert!(code == Some(0) && !err.contains("nominal") && !err.contains("delay"), "{err}");
    let text = folder.text("leaf.toml");
    assert!(text.contains("\nnominal = 10\n") && text.contains("\ndelay = 3.0"), "{text}");
    assert_eq!(text.matches("# From the edge of the camera's sync").count(), 1, "{text}");
    // Comments in an array, and a count with a point, are kept; lines of an older fit are not, whatever stands between.
    let own = first
        .replace("# Exposure ", "# of Monday\n# Exposure ")
        .replace("triggers = 16", "triggers = 12.0");
    folder.write("leaf.toml", &own);
    assert_eq!(folder.run("fit trace.csv --out leaf.toml --sync 0").0, Some(0));
    let text = folder.text("leaf.toml");
    assert!(text.contains("# of Monday\n") && text.contains("\ntriggers = 12\n"), "{text}");
    assert_eq!(text.matches("\n# Exposure ").count(), 1, "{text}");
    let array = "trigger_times = [ # by hand\n  1, 2, # late\n]\nopen_start = ";
    folder.write("leaf.toml", &first.replace("open_start = ", array));
    assert_eq!(folder.run("fit trace.csv --out leaf.toml --sync 0").0, Some(0));
    let text = folder.text("leaf.toml");
    assert!(text.contains("\n# by hand\n# late\nopen_start = "), "{text}");
    // What is asked for counts, in the unit of the scene.
    let mine = "unit = 'us'\nmin_gap = 200\n# mine\nopen_start = 1 # too\nclose_start = 2 # gone\ntriggers = 9\n";
    folder.write("leaf.toml", mine);
    folder.refuses("$shutter fit trace.csv --out leaf.toml", "no scene that a fit wrote");
    let (mark, _) = first.split_once('\n').unwrap();
    folder.write("leaf.toml", &format!("{mark}\n{mine}"));
    let (code, _, err) = folder.run("fit trace.csv --out leaf.toml --triggers 6");
    assert_eq!(code, Some(0), "{err}");
    let text = folder.text("leaf.toml");
    assert!(text.contains("unit = 'us'\n# set_up = "), "{text}");
    assert!(text.contains("min_gap = 200\n# mine\nopen_start = 20"), "{text}");
    assert!(
        text.contains(" # too\n")
            && text.contains(" # gone\n")
            && text.contains("\ntriggers = 6\n"),
        "{text}"
    );
    // What it keeps has to go with the shutter; a file that is no scene is not replaced.
    folder.write("leaf.toml", &edited.replace("min_gap = 0.1", "min_gap = 3"));
    folder.refuses("$shutter fit trace.csv --out leaf.toml", "with what it keeps, pulses 0 and 1");
    folder.write("leaf.toml", "[package]\nname = 'mine'\n");
    folder.refuses("$shutter fit trace.csv --out leaf.toml", "--force");
    let (code, _, _) = folder.run("fit trace.csv --out leaf.toml --sync 0 --force");
    assert_eq!((code, folder.text("leaf.toml")), (Some(0), first));
}

/// A speed among several keeps its own.
#[test]
fn several_fits_keep_what_a_user_wrote() {
    let folder = Folder::new("kept_speeds");
    folder.write("v1.5.csv", &trace(2.0));
    assert_eq!(folder.run("fit trace.csv v1.5.csv --out .").0, Some(0));
    folder.write("v1.5.toml", &folder.text("v1.5.toml").replace("min_gap = 0 ", "min_gap = 0.2 "));
    let (code, _, err) = folder.run("fit trace.csv v1.5.csv --nominal 1/200,1/100 --out .");
    let told = "./v1.5.toml: kept min_gap = 0.2\nwrote ./trace.toml\nwrote ./v1.5.toml\nnext: ";
    assert!(code == Some(0) && err.starts_with(told), "{err}");
    assert!(folder.text("v1.5.toml").contains("nominal = 10\n"));
}

/// A reader who leaves is no error.
#[test]
fn a_closed_pipe_is_no_error() {
    let mut shutter = Command::new(SHUTTER)
        .args(["plan", "--emit", "json"])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = [0];
    shutter.stdout.take().unwrap().read_exact(&mut first).unwrap();
    assert_eq!((shutter.wait().unwrap().code(), first), (Some(0), *b"{"));
    let _ = std::io::stdout().flush();
}
