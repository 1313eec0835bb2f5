//! The program loses nothing: each way to lose a file that we know of is tried here, with the program as it is run.
#![cfg(unix)]

use std::fs::{self, File};
use std::os::unix::fs::{PermissionsExt, symlink};

use shutter_plan::scene::Written;

use crate::scenes::{MEASURED, TRAPEZOID, with};
use crate::support::{Folder, Run, has, leaf};

/// A folder with a scene and a trace of straight ramps.
fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("scene.toml", with(TRAPEZOID, "set_up = 'emulated'"));
    folder.write("trace.csv", leaf(1.0));
    folder
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
        folder.refuses(&[(args, "it is the input"), (&format!("{args} --force"), "it is the input")]);
    }
    folder.refuses(&[
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
    folder.refuses(&[
        ("plan --out new.svg --emit c --to new.svg", "two outputs"),
        ("plan --out new.svg --emit c --to sub/../new.svg", "two outputs"),
        ("plan --out new.svg --emit c --to link.svg", "two outputs"),
        ("plan --force --out old.svg --emit c --to hard.svg", "two outputs"),
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
    folder.refuses(&[
        ("fit trace.csv --out notes", "--force"),
        ("plan --out link.svg", "--force"),
        ("plan --emit csv --to notes", "--force"),
        ("fit trace.csv --picture link.svg", "--force"),
    ]);
    folder.run("plan --emit csv --to notes --force").well();
    assert!(folder.text("notes").starts_with("scene,index,"));
    assert!(folder.path("link.svg").is_symlink());
    // What it wrote is replaced while nobody has changed it: by its mark, or by the same bytes where it has none.
    for form in ["rust", "c", "csv", "json"] {
        let (file, line) = (format!("made.{form}"), format!("plan --emit {form} --to made.{form}"));
        let wrote = format!("warning: no scene is named, so this is the example, soft\nwrote {file}\n");
        for _ in 0..2 {
            assert_eq!(folder.run(&line).well().err, wrote);
        }
        let (has_mark, other) = (matches!(form, "rust" | "c"), format!("{line} --triggers 5"));
        match has_mark {
            true => drop(folder.run(&other).well()),
            false => folder.refuses(&[(&other, "a table does not tell whose")]),
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
            folder.refuses(&[(&line, reason)]);
        }
        // Editors may do these.
        for edited in [format!("\u{feff}{text}"), text.replace('\n', "\r\n")] {
            folder.write(&file, &edited);
            let line = if has_mark { line.clone() } else { format!("{line} --force") };
            assert_eq!(folder.run(&line).well().err, wrote);
            assert_ne!(folder.text(&file), edited);
        }
    }
    // The checksum of older versions, as it is published with the algorithm.
    folder.write("old.h", "/* Checksum bf9cf968 of the lines below: `shutter` replaces them while it holds */\nfoobar");
    folder.run("plan --emit c --to old.h").well();
    for _ in 0..2 {
        folder.run("plan --out made.svg").well();
    }
    folder.run("fit trace.csv --picture made.svg").well();
    folder.write("made.svg", folder.text("made.svg").replace("<svg ", "<svg  "));
    // A scene holds what its user wrote whether or not its mark does.
    folder.run("fit trace.csv --out leaf.toml").well();
    folder.refuses(&[
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
    folder.refuses(&[
        ("fit none.csv --out notes", "notes: it holds no scene that a fit wrote"),
        ("fit none.csv --picture notes.svg", "notes.svg: it holds something else"),
        ("fit none.csv --out none/leaf.toml", "its folder is not there"),
        ("fit none.csv --out ok.toml --picture none/leaf.svg", "its folder is not there"),
    ]);
    // Five nanoseconds are too short for sixteen triggers.
    folder.write("ns.csv", leaf(1.0).replace("time_ms", "time_ns"));
    let args = "fit ns.csv --out ns.toml";
    folder.refuses(&[(args, "ask for fewer triggers (--triggers)")]);
    assert!(folder.run(args).out.contains("\nexposure     5.00"));
    folder.run("fit ns.csv --out ns.toml --triggers 4").well();
}

#[test]
fn links_are_written_through_and_other_names_keep_what_they_had() {
    let folder = folder("links");
    fs::create_dir(folder.path("far")).unwrap();
    symlink("far/new.svg", folder.path("link.svg")).unwrap();
    symlink("link.svg", folder.path("twice.svg")).unwrap();
    folder.run("plan --out twice.svg").well();
    assert!(folder.path("link.svg").is_symlink() && folder.path("twice.svg").is_symlink());
    assert!(folder.text("far/new.svg").contains("\n<svg "));
    // The mode stays, and a new file's is that of any new file.
    fs::set_permissions(folder.path("far/new.svg"), PermissionsExt::from_mode(0o604)).unwrap();
    fs::hard_link(folder.path("far/new.svg"), folder.path("other.svg")).unwrap();
    let older = folder.text("other.svg");
    let plan = "$shutter plan --triggers 3 --out link.svg --emit c --to fresh.h --force";
    folder.shell(&format!("umask 027; {plan}")).well();
    let mode = |name: &str| fs::metadata(folder.path(name)).unwrap().permissions().mode() & 0o777;
    assert_eq!((mode("far/new.svg"), mode("fresh.h")), (0o604, 0o640));
    assert!(folder.text("far/new.svg") != older && folder.text("other.svg") == older);
    assert!(folder.path("link.svg").is_symlink());
    symlink("round.svg", folder.path("round.svg")).unwrap();
    folder.refuses(&[("plan --out round.svg", "round.svg: ")]);
}

#[test]
fn devices_and_pipes_are_written_to() {
    let folder = folder("streams");
    folder.run("plan --out /dev/null --emit c --to /dev/null").well();
    let csv = folder.run("plan --emit csv").well().out;
    assert_eq!(folder.run("plan --emit csv --to /dev/stdout").out, csv);
    let piped = "mkfifo pipe.svg; cat pipe.svg & $shutter plan --out pipe.svg > text; wait";
    for line in [piped, "$shutter plan --out -"] {
        let out = folder.shell(line).prints(&["\n<svg "]).out;
        assert!(out.ends_with("</svg>\n"), "{out}");
    }
    assert!(folder.text("text").contains("exposure"));
    let plan = "$shutter plan - --set-up emulated --timer-hz 1MHz --min-gap 0 --emit csv --to -";
    let out = folder.shell(&format!("$shutter fit trace.csv --out - | {plan}")).well().out;
    assert!(out.starts_with("scene,index,u,"), "{out}");
    let json = folder.shell("$shutter fit - --report json < trace.csv");
    json.prints(&["\"trace\": \"standard input\""]);
    // A reader who leaves is no error.
    let line = "{ $shutter plan --emit json; echo $? >&2; } | head -c 1";
    assert_eq!(
        folder.shell(line),
        Run {
            code: Some(0),
            out: "{".into(),
            err: "warning: no scene is named, so this is the example, soft\n0\n".into()
        }
    );
}

/// A file whose writing fails at any block leaves the old ones and no other: here a limit is in place of a full disk.
/// Beyond it a write is a signal, too, which ends the program where it stands: then each file is the old one, whole.
#[test]
fn a_full_disk_and_a_kill_leave_the_old_files() {
    let folder = folder("full");
    folder.run("plan --out a.svg --emit c --to c.h").well();
    let line = "plan scene.toml --out a.svg --emit c --to c.h --force";
    let limited = |first, blocks| folder.shell(&format!("{first}; ulimit -f {blocks}; exec \"$shutter\" {line}"));
    let (before, mut stopped) = (folder.all(), 0);
    loop {
        let (killed, blocks) = (limited("ulimit -c 0", 7 * stopped), 7 * stopped);
        if killed.code == Some(0) {
            break;
        }
        assert!(killed.code.is_none(), "{blocks}: {killed:?}");
        for left in folder.names().iter().filter(|name| name.starts_with(".shutter-")) {
            fs::remove_file(folder.path(left)).unwrap();
        }
        let run = limited("trap '' XFSZ", blocks);
        assert!(run.code == Some(2) && run.err.contains("File too large"), "{blocks}: {run:?}");
        assert!(folder.all() == before, "{blocks}");
        stopped += 1;
    }
    assert!(stopped > 3 && folder.all() != before, "{stopped}");
    // A full device, standard output as well: then no file is new either.
    folder.refuses(&[
        ("plan --out new.svg --emit c --to /dev/full", "No space left"),
        ("plan --out new.svg > /dev/full", "No space left"),
    ]);
}

#[test]
fn two_runs_at_once_leave_one_of_theirs() {
    let folder = folder("race");
    let whole = [3, 4].map(|n| {
        folder.run(&format!("plan --triggers {n} --out {n}.svg")).well();
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
    folder.run("fit trace.csv --out old.toml").well();
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
    folder.write("bare.toml", with(TRAPEZOID, ""));
    folder.refuses(&[
        ("plan --emit c --to ok.h --out taken.svg", "it is a folder"),
        ("plan --emit c --to ok.h --out none/new.svg", "its folder is not there"),
        ("fit trace.csv --picture ok.svg --out none/leaf.toml", "its folder is not there"),
        // A failed plan, and a form for which the scene lacks something.
        ("plan scene.toml --triggers 8 --emit c --to leaf.h --force", "triggers"),
        ("plan bare.toml --out ok.svg --emit c --to leaf.h --force", "bare.toml: hardware needs"),
    ]);
    // Whoever made it read-only does not want it replaced, and root is no exception.
    fs::set_permissions(folder.path("leaf.h"), PermissionsExt::from_mode(0o444)).unwrap();
    folder.refuses(&[("plan --emit c --to leaf.h --force", "it is read-only")]);
    let locked = folder.path("locked");
    fs::create_dir(&locked).unwrap();
    fs::set_permissions(&locked, PermissionsExt::from_mode(0o555)).unwrap();
    // Root may write there.
    if File::create(locked.join("probe")).is_err() {
        folder.refuses(&[("plan --emit c --to ok.h --out locked/new.svg", "permission denied")]);
    }
    fs::set_permissions(&locked, PermissionsExt::from_mode(0o755)).unwrap();
}

/// A scene's text without its shutter, and its shutter.
fn apart(scene: &str) -> (String, &str) {
    let at = Written::find(scene).unwrap().at;
    (format!("{}{}", &scene[..at.start], &scene[at.end..]), &scene[at])
}

/// What a fit measures, it replaces as a whole; what a hand wrote, it never touches.
#[test]
fn a_fit_replaces_its_table_and_nothing_else() {
    let folder = folder("kept");
    let fit = |args: &str| folder.run(&format!("fit {args} --out leaf.toml")).well().err;
    let scene = || folder.text("leaf.toml");
    let next = "next: shutter plan leaf.toml --set-up emulated|in_path --timer-hz HERTZ --min-gap TIME";
    let wrote = format!("wrote leaf.toml\n{next} --sync-falls true|false --emit rust --to leaf.rs\n");
    assert_eq!(fit("trace.csv --sync 0"), wrote);
    let first = scene();
    assert_eq!((fit("trace.csv --sync 0"), scene()), (wrote, first.clone()), "nothing piles up");
    // All of it but the shutter is the user's, wherever it stands and whatever it is.
    let own = "# by the scope\n# Exposure bracket: 3 frames\n[flashes] # mine\nunit='us'\ntriggers = 5.0\n\
               timer_hz = 84_000_000 # TIM2\nmin_gap =  100\nset_up = \"in_path\"\nduty = 0.3\n# Warning: hot\n\n";
    let (_, shutter) = apart(&first);
    folder.write("slow.csv", leaf(2.0));
    for edited in [format!("{own}{shutter}# the end\n"), format!("# of Monday\n\n{shutter}\n{own}")] {
        folder.write("leaf.toml", &edited);
        let err = fit("slow.csv --nominal 1/125");
        let gone = "warning: leaf.toml: its delay of 2.0009947 ms is gone: this fit has no --sync\n";
        let next = "wrote leaf.toml\nnext: shutter plan leaf.toml --emit rust --to leaf.rs\n";
        assert!(err.starts_with(&gone[..30]) && err.ends_with(next), "{err}");
        let now = scene();
        assert_eq!(apart(&now).0, apart(&edited).0);
        // Neither a delay nor a spread that it did not measure is left.
        has(&now, &["\nnominal = 8.0\n", "\nclose_end = 14.00", "\ntrace = \"slow.csv\"\n"], &["delay", "trace.csv"]);
        assert_eq!(folder.run("plan leaf.toml --emit json").well().err, "");
    }
    // The unit stays, since the flashes may count in it.
    let us = first.replace("unit = \"ms\"", "unit = \"us\"");
    folder.write("leaf.toml", &us);
    fit("trace.csv --sync 0 --force");
    has(&scene(), &["[shutter]\nunit = \"µs\"\nopen_start = 0.0\nopen_end = 1997", "\ndelay = 20"], &[]);
    // What a hand changed in the shutter is not lost, be it a comment.
    let below = "you have changed what a fit wrote below [shutter]; what is yours belongs below [flashes]";
    let foreign = "it holds no scene that a fit wrote; --force replaces it all";
    let edited = |from, to| first.replacen(from, to, 1);
    for (text, reason) in [
        (edited("open_start", "# mine\nopen_start"), below),
        (edited("\nshots", " # mine\nshots"), below),
        (edited("delay = ", "delay = 1"), below),
        (edited("unit = \"ms\"", "unit = \"us\""), below),
        (edited("checksum = \"", "nominal = 1\nchecksum = \""), foreign),
        (MEASURED.replace("[shutter.measured]", "[shutter.own]"), foreign),
        ("[package]\nname = 'mine'\n".into(), foreign),
        (with(TRAPEZOID, ""), "no fit wrote its [shutter]; --force"),
    ] {
        folder.write("leaf.toml", &text);
        folder.refuses(&[("fit slow.csv --out leaf.toml", reason)]);
        if reason == below {
            let told = "doubt        what a fit wrote below [shutter] was changed by hand since";
            has(&folder.run("plan leaf.toml").well().out, &[told], &[]);
            fit("trace.csv --sync 0 --force");
            assert_eq!(apart(&scene()).0, apart(&text).0);
        }
    }
    fit("trace.csv --sync 0 --force");
    has(&scene(), &["triggers = 7\ntimer_hz = 1000\n"], &["# Yours"]);
    // Editors may end lines otherwise.
    folder.write("leaf.toml", first.replace('\n', "\r\n"));
    fit("trace.csv --sync 0");
    // An option against what is the user's.
    folder.refuses(&[(
        "fit trace.csv --triggers 6 --out leaf.toml",
        "it has triggers = 16 below [flashes], which are yours",
    )]);
    // Flashes that do not go with the shutter are told, and the scene is there for its user to mend them.
    folder.write("leaf.toml", first.replace("# min_gap = 0.1", "min_gap = 9"));
    has(&fit("trace.csv --sync 0"), &["warning: leaf.toml: as it is, triggers: triggers 0 and 1 come "], &[]);
}
