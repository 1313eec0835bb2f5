//! The program loses nothing: each way to lose a file that we know of is tried here, with the program as it is run.
#![cfg(unix)]

use std::fs::{self, File};
use std::os::unix::fs::{PermissionsExt, symlink};

use crate::refusals::{TRAPEZOID, with};
use crate::support::{Folder, Run, has, leaf};

/// A folder with a scene and a trace of straight ramps.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("scene.toml", with(TRAPEZOID, "set_up = 'emulated'"));
    folder.write("trace.csv", leaf(1.0));
    folder
}

impl Folder {
    /// Runs the program with these arguments, by a shell.
    fn exec(&self, args: &str) -> Run {
        self.shell(&format!("exec \"$shutter\" {args}"))
    }

    /// Each run is refused for this reason, and all files are as they were.
    #[track_caller]
    fn keeps(&self, runs: &[(&str, &str)]) {
        for (args, reason) in runs {
            let before = self.all();
            let run = self.exec(args);
            assert!(run.code == Some(2) && run.err.contains(reason), "{args}: {run:?}");
            assert!(self.all() == before, "{args}");
        }
    }
}

#[test]
fn an_output_that_is_an_input_is_refused_by_any_name() {
    let folder = folder("inputs");
    symlink("trace.csv", folder.path("link.toml")).unwrap();
    symlink(&folder.0, folder.path("again")).unwrap();
    fs::hard_link(folder.path("trace.csv"), folder.path("hard.toml")).unwrap();
    fs::hard_link(folder.path("scene.toml"), folder.path("hard.svg")).unwrap();
    // Traces that are called as their scenes would be.
    folder.write("a.toml", leaf(1.0));
    folder.write("b.toml", leaf(2.0));
    for args in [
        "fit trace.csv --out trace.csv",
        "fit trace.csv --out ./trace.csv",
        "fit trace.csv --out link.toml",
        "fit trace.csv --out hard.toml",
        "fit trace.csv --out again/trace.csv",
        "fit trace.csv --out ../inputs/trace.csv",
        "fit link.toml --out trace.csv",
        "plan scene.toml --out hard.svg",
        "plan scene.toml --emit c --to scene.toml",
        "fit a.toml b.toml --out .",
    ] {
        folder.keeps(&[(args, "it is the input"), (&format!("{args} --force"), "it is the input")]);
    }
    folder.keeps(&[
        ("plan scene.toml --emit rust >> scene.toml", "standard output"),
        ("fit - --out trace.csv --force < trace.csv", "standard input"),
    ]);
}

#[test]
fn two_outputs_of_one_file_are_refused() {
    let folder = folder("two");
    symlink("new.svg", folder.path("link.svg")).unwrap();
    fs::create_dir(folder.path("sub")).unwrap();
    folder.write("sub/trace.csv", leaf(2.0));
    folder.write("old.svg", "old");
    fs::hard_link(folder.path("old.svg"), folder.path("hard.svg")).unwrap();
    folder.keeps(&[
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
    ]);
}

#[test]
fn a_file_of_something_else_needs_force() {
    let folder = folder("force");
    folder.write("notes", "what I measured\n");
    symlink("notes", folder.path("link.svg")).unwrap();
    folder.keeps(&[
        ("fit trace.csv --out notes", "--force"),
        ("plan --out link.svg", "--force"),
        ("plan --emit csv --to notes", "--force"),
        ("fit trace.csv --picture link.svg", "--force"),
    ]);
    folder.exec("plan --emit csv --to notes --force").well();
    assert!(folder.text("notes").starts_with("scene,index,"));
    assert!(folder.path("link.svg").is_symlink());
    // What it wrote is replaced while nobody has changed it: by its mark, or by the same bytes where it has none.
    for form in ["rust", "c", "csv", "json"] {
        let (file, line) = (format!("made.{form}"), format!("plan --emit {form} --to made.{form}"));
        let wrote = format!("wrote {file}\n");
        for _ in 0..2 {
            assert_eq!(folder.exec(&line).well().err, wrote);
        }
        let (has_mark, other) = (matches!(form, "rust" | "c"), format!("{line} --triggers 5"));
        match has_mark {
            true => drop(folder.exec(&other).well()),
            false => folder.keeps(&[(&other, "a table does not tell whose")]),
        }
        let text = folder.text(&file);
        let changed = if has_mark { "you have changed it since" } else { "--force" };
        for (edited, reason) in [
            (format!("{text}\n"), changed),
            (text.replace("soft", "hard"), changed),
            // A remark beside the mark is its user's.
            (text.replacen('\n', " for board 7\n", 1), "--force"),
            (format!("mine {text}"), "--force"),
        ] {
            folder.write(&file, edited);
            folder.keeps(&[(&line, reason)]);
        }
        // Editors may do these.
        for edited in [format!("\u{feff}{text}"), text.replace('\n', "\r\n")] {
            folder.write(&file, &edited);
            let line = if has_mark { line.clone() } else { format!("{line} --force") };
            assert_eq!(folder.exec(&line).well().err, wrote);
            assert_ne!(folder.text(&file), edited);
        }
    }
    // The checksum of older versions, as it is published with the algorithm.
    folder.write("old.h", "/* Checksum bf9cf968 of the lines below: `shutter` replaces them while it holds */\nfoobar");
    folder.exec("plan --emit c --to old.h").well();
    for _ in 0..2 {
        folder.exec("plan --out made.svg --set-ups both.svg").well();
    }
    folder.exec("fit trace.csv --picture made.svg").well();
    folder.write("made.svg", folder.text("made.svg").replace("<svg ", "<svg  "));
    // A scene holds what its user wrote whether or not its mark does.
    folder.exec("fit trace.csv --out leaf.toml").well();
    folder.keeps(&[
        ("fit trace.csv --picture made.svg", "you have changed it since"),
        ("plan --emit rust --to leaf.toml", "--force"),
    ]);
}

/// What cannot be written is told before a trace is even read; what fails after the fit leaves its report.
#[test]
fn a_fit_is_not_lost_with_its_files() {
    let folder = folder("late");
    folder.write("notes", "mine\n");
    symlink("notes", folder.path("notes.svg")).unwrap();
    folder.keeps(&[
        ("fit none.csv --out notes", "notes: it holds no scene that a fit wrote"),
        ("fit none.csv --picture notes.svg", "notes.svg: it holds something else"),
        ("fit none.csv --out none/leaf.toml", "its folder is not there"),
        ("fit none.csv --out ok.toml --picture none/leaf.svg", "its folder is not there"),
    ]);
    folder.exec("fit trace.csv --out leaf.toml").well();
    folder.write("leaf.toml", folder.text("leaf.toml").replace("min_gap = 0 ", "min_gap = 9 "));
    // Five nanoseconds are too short for sixteen triggers.
    folder.write("ns.csv", leaf(1.0).replace("time_ms", "time_ns"));
    for (args, reason) in [
        ("fit trace.csv --out leaf.toml", "with what it keeps"),
        ("fit ns.csv --out ns.toml", "ask for fewer triggers (--triggers)"),
    ] {
        folder.keeps(&[(args, reason)]);
        assert!(folder.exec(args).out.contains("\nexposure     5.00"), "{args}");
    }
    folder.exec("fit ns.csv --out ns.toml --triggers 4").well();
}

#[test]
fn links_are_written_through_and_other_names_keep_what_they_had() {
    let folder = folder("links");
    fs::create_dir(folder.path("far")).unwrap();
    symlink("far/new.svg", folder.path("link.svg")).unwrap();
    symlink("link.svg", folder.path("twice.svg")).unwrap();
    folder.exec("plan --out twice.svg").well();
    assert!(folder.path("link.svg").is_symlink() && folder.path("twice.svg").is_symlink());
    assert!(folder.text("far/new.svg").contains("\n<svg "));
    // The mode stays, and a new file's is that of any new file.
    fs::set_permissions(folder.path("far/new.svg"), PermissionsExt::from_mode(0o604)).unwrap();
    fs::hard_link(folder.path("far/new.svg"), folder.path("other.svg")).unwrap();
    let older = folder.text("other.svg");
    let plan = "$shutter plan --triggers 3 --out link.svg --set-ups fresh.svg --force";
    folder.shell(&format!("umask 027; {plan}")).well();
    let mode = |name: &str| fs::metadata(folder.path(name)).unwrap().permissions().mode() & 0o777;
    assert_eq!((mode("far/new.svg"), mode("fresh.svg")), (0o604, 0o640));
    assert!(folder.text("far/new.svg") != older && folder.text("other.svg") == older);
    assert!(folder.path("link.svg").is_symlink());
    symlink("round.svg", folder.path("round.svg")).unwrap();
    folder.keeps(&[("plan --out round.svg", "round.svg: ")]);
}

#[test]
fn devices_and_pipes_are_written_to() {
    let folder = folder("streams");
    folder.exec("plan --out /dev/null --set-ups /dev/null").well();
    let csv = folder.exec("plan --emit csv").well().out;
    assert_eq!(folder.exec("plan --emit csv --to /dev/stdout").out, csv);
    let piped = "mkfifo pipe.svg; cat pipe.svg & $shutter plan --out pipe.svg > text; wait";
    for line in [piped, "$shutter plan --out -"] {
        let out = folder.shell(line).prints(&["\n<svg "]).out;
        assert!(out.ends_with("</svg>\n"), "{out}");
    }
    assert!(folder.text("text").contains("exposure"));
    let plan = "$shutter plan - --set-up emulated --timer-hz 1MHz --emit csv --to -";
    let out = folder.shell(&format!("$shutter fit trace.csv --out - | {plan}")).well().out;
    assert!(out.starts_with("scene,index,u,"), "{out}");
    let json = folder.shell("$shutter fit - --report json < trace.csv");
    json.prints(&["\"trace\": \"standard input\""]);
    // A reader who leaves is no error.
    let line = "{ $shutter plan --emit json; echo $? >&2; } | head -c 1";
    assert_eq!(folder.shell(line), Run { code: Some(0), out: "{".into(), err: "0\n".into() });
}

/// A file whose writing fails at any block leaves the old ones and no other: here a limit is in place of a full disk.
#[test]
fn a_full_disk_leaves_the_old_files() {
    let folder = folder("full");
    folder.exec("plan --out a.svg --set-ups b.svg --emit c --to c.h").well();
    let line = "plan scene.toml --out a.svg --set-ups b.svg --emit c --to c.h --force";
    let mut refused = 0;
    for blocks in (0..200).step_by(5) {
        let before = folder.all();
        let run = folder.shell(&format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$shutter\" {line}"));
        if run.code == Some(0) {
            break;
        }
        assert!(run.code == Some(2) && run.err.contains("File too large"), "{blocks}: {run:?}");
        assert!(folder.all() == before, "{blocks}");
        refused += 1;
    }
    assert!(refused > 3, "{refused}");
    // A full device, standard output as well: then no file is new either.
    folder.keeps(&[
        ("plan --out new.svg --emit c --to /dev/full", "No space left"),
        ("plan --out new.svg > /dev/full", "No space left"),
    ]);
}

/// Whenever it is killed while it writes, each file is the old one or the new one, whole.
#[test]
fn a_kill_leaves_whole_files() {
    let folder = folder("killed");
    let files = || [folder.text("a.svg"), folder.text("c.h")];
    let plan = |n| format!("plan --triggers {n} --out a.svg --emit c --to c.h --force");
    let [old, new] = [3, 4].map(|n| {
        folder.exec(&plan(n)).well();
        files()
    });
    let (mut killed, mut blocks) = (0, 0);
    loop {
        folder.write("a.svg", &old[0]);
        folder.write("c.h", &old[1]);
        // Beyond the limit a write is a signal, which ends the program where it stands.
        let limits = format!("ulimit -c 0; ulimit -f {blocks}");
        let run = folder.shell(&format!("{limits}; exec \"$shutter\" {}", plan(4)));
        if run.code == Some(0) {
            assert!(files() == new);
            break;
        }
        assert!(run.code.is_none() && files() == old, "{blocks}: {:?}", run.code);
        (killed, blocks) = (killed + 1, blocks + 7);
    }
    assert!(killed > 3, "{killed}");
}

#[test]
fn two_runs_at_once_leave_one_of_theirs() {
    let folder = folder("race");
    let whole = [3, 4].map(|n| {
        folder.exec(&format!("plan --triggers {n} --out {n}.svg")).well();
        folder.text(&format!("{n}.svg"))
    });
    for _ in 0..10 {
        let _ = fs::remove_file(folder.path("new.svg"));
        let runs =
            "for n in 3 4 3 4; do $shutter plan --triggers $n --out new.svg > /dev/null 2>&1 && echo well & done; wait";
        folder.shell(runs).prints(&["well"]);
        assert!(whole.contains(&folder.text("new.svg")));
    }
    assert_eq!(folder.names(), ["3.svg", "4.svg", "new.svg", "scene.toml", "trace.csv"]);
}

/// What a user saves while a fit is under way is not replaced.
#[test]
fn a_file_that_changes_meanwhile_is_kept() {
    let folder = folder("meanwhile");
    folder.exec("fit trace.csv --out old.toml").well();
    for out in ["old.toml", "new.toml"] {
        let line = format!(
            "mkfifo {out}.in; $shutter fit - --out {out} < {out}.in & exec 3> {out}.in; sleep 0.5\n\
             echo '# by hand' >> {out}; cat trace.csv >&3; exec 3>&-; wait $!"
        );
        let run = folder.shell(&line);
        assert!(run.code == Some(2) && run.err.contains("it has changed meanwhile"), "{out}: {run:?}");
        assert!(folder.text(out).ends_with("# by hand\n"));
    }
    assert!(!folder.names().iter().any(|name| name.starts_with(".shutter")));
}

#[test]
fn what_cannot_be_written_leaves_nothing() {
    let folder = folder("unwritten");
    fs::create_dir(folder.path("taken.svg")).unwrap();
    folder.write("leaf.h", "/* old */\n");
    folder.write("bare.toml", TRAPEZOID);
    folder.keeps(&[
        ("plan --set-ups ok.svg --out taken.svg", "it is a folder"),
        ("plan --set-ups ok.svg --out none/new.svg", "its folder is not there"),
        ("fit trace.csv --picture ok.svg --out none/leaf.toml", "its folder is not there"),
        // A failed plan, and a form for which the scene lacks something.
        ("plan scene.toml --triggers 8 --emit c --to leaf.h --force", "triggers"),
        ("plan bare.toml --out ok.svg --emit c --to leaf.h --force", "bare.toml: hardware needs"),
    ]);
    // Whoever made it read-only does not want it replaced, and root is no exception.
    fs::set_permissions(folder.path("leaf.h"), PermissionsExt::from_mode(0o444)).unwrap();
    folder.keeps(&[("plan --emit c --to leaf.h --force", "it is read-only")]);
    let locked = folder.path("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, PermissionsExt::from_mode(0o555)).unwrap();
    // Root may write there.
    if File::create(locked.join("probe")).is_err() {
        folder.keeps(&[("plan --set-ups ok.svg --out locked/new.svg", "permission denied")]);
    }
    fs::set_permissions(&locked, PermissionsExt::from_mode(0o755)).unwrap();
}

#[test]
fn a_new_fit_keeps_what_a_user_wrote() {
    let folder = folder("kept");
    let fit = |args: &str| folder.exec(&format!("fit {args} --out leaf.toml")).well().err;
    let scene = || folder.text("leaf.toml");
    let wrote = "wrote leaf.toml\nnext: write set_up, timer_hz, sync_falls into the scene, then \
                 shutter plan leaf.toml --emit rust --to leaf.rs\n";
    assert_eq!(fit("trace.csv --sync 0"), wrote);
    let first = scene();
    // Of its own it keeps nothing, and piles nothing up.
    assert_eq!((fit("trace.csv --sync 0").as_str(), scene()), (wrote, first.clone()));
    let edited = first
        .replace("# timer_hz = ... # your timer's rate, in Hz", "timer_hz = 84_000_000 # TIM2")
        .replace("# sync_falls = ... # true, or", "sync_falls = false # not true, nor")
        .replace("# set_up = \"in_path\" #", "set_up = \"in_path\" #")
        .replace("min_gap = 0 ", "min_gap = 0.1 ")
        .replace("triggers = 16", "# as many as the LED takes\ntriggers = 5")
        .replace("open_start = ", "duty = 0.3\n# by the scope\nopen_start = ")
        + "# the end\n";
    folder.write("leaf.toml", &edited);
    folder.write("slow.csv", leaf(2.0));
    let err = fit("slow.csv --nominal 1/125");
    has(&err, &["timer_hz = 84000000", "min_gap = 0.1", "duty = 0.3", "delay = 2.0", "in_path", "comments"], &[]);
    assert!(err.ends_with("\nnext: shutter plan leaf.toml --emit rust --to leaf.rs\n"), "{err}");
    has(
        &scene(),
        &[
            "\ntimer_hz = 84_000_000 # TIM2\n",
            "\n# as many as the LED takes\n",
            "\ntriggers = 5\n",
            "\n# by the scope\n",
            "\nduty = 0.3\n",
            "\nnominal = 8\n",
            " holds\n# Fitted to slow.csv",
            "# the end\n",
            "\nset_up = \"in_path\"",
            "\nsync_falls = false",
            "\nopen_start = 4.0",
            "± ",
        ],
        // What the user has answered is asked no more.
        &["trace.csv", "# delay = ?", "# set_up", "# sync_falls", "# timer_hz"],
    );
    has(&fit("slow.csv --nominal 1/100 --sync 1ms"), &[], &["nominal", "delay"]);
    has(&scene(), &["\nnominal = 10\n", "\ndelay = 3.0"], &[]);
    assert_eq!(scene().matches("# From the edge of the camera's sync").count(), 1, "{}", scene());
    // Comments in an array, and a count with a point, are kept; lines of an older fit are not, whatever stands between.
    let own = first.replace("# Exposure ", "# of Monday\n# Exposure ");
    folder.write("leaf.toml", own.replace("triggers = 16", "triggers = 12.0"));
    fit("trace.csv --sync 0");
    has(&scene(), &["# of Monday\n", "\ntriggers = 12\n"], &[]);
    assert_eq!(scene().matches("\n# Exposure ").count(), 1, "{}", scene());
    let array = "trigger_times = [ # by hand\n  1, 2, # late\n]\nopen_start = ";
    folder.write("leaf.toml", first.replace("open_start = ", array));
    fit("trace.csv --sync 0");
    has(&scene(), &["\n# by hand\n# late\nopen_start = "], &[]);
    // What is asked for counts, in the unit of the scene.
    let mine = "unit = 'us'\nmin_gap = 200\n# mine\nopen_start = 1 # too\nclose_start = 2 # gone\ntriggers = 9\n";
    folder.write("leaf.toml", mine);
    folder.keeps(&[("fit trace.csv --out leaf.toml", "no scene that a fit wrote")]);
    let (mark, _) = first.split_once('\n').unwrap();
    folder.write("leaf.toml", format!("{mark}\n{mine}"));
    fit("trace.csv --triggers 6");
    has(
        &scene(),
        &[
            "unit = 'us'\n# set_up = ",
            "min_gap = 200\n# mine\nopen_start = 20",
            " # too\n",
            " # gone\n",
            "\ntriggers = 6\n",
        ],
        &[],
    );
    // What it keeps has to go with the shutter; a file that is no scene is not replaced.
    for (text, reason) in [
        (edited.replace("min_gap = 0.1", "min_gap = 3"), "with what it keeps, pulses 0 and 1"),
        ("[package]\nname = 'mine'\n".into(), "--force"),
    ] {
        folder.write("leaf.toml", text);
        folder.keeps(&[("fit trace.csv --out leaf.toml", reason)]);
    }
    fit("trace.csv --sync 0 --force");
    assert_eq!(scene(), first);
}

/// A speed among several keeps its own.
#[test]
fn several_fits_keep_what_a_user_wrote() {
    let folder = folder("kept_speeds");
    folder.write("v1.5.csv", leaf(2.0));
    folder.exec("fit trace.csv v1.5.csv --out .").well();
    folder.write("v1.5.toml", folder.text("v1.5.toml").replace("min_gap = 0 ", "min_gap = 0.2 "));
    let err = folder.exec("fit trace.csv v1.5.csv --nominal 1/200,1/100 --out .").well().err;
    let told = "./v1.5.toml: kept min_gap = 0.2\nwrote ./trace.toml\nwrote ./v1.5.toml\nnext: ";
    assert!(err.starts_with(told), "{err}");
    assert!(folder.text("v1.5.toml").contains("nominal = 10\n"));
}
