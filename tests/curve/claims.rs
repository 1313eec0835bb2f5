//! What the crate's pages claim, and what holds it. A claim is a sentence, or a row of a table, with a number or one of
//! [`WORDS`], outside of code.

use std::path::Path;

const PAGES: [&str; 5] = ["README.md", "docs/accuracy.md", "src/lib.rs", "src/shutter.rs", "src/trigger/timed.rs"];
const WORDS: [&str; 6] = ["never", "every", "always", "at most", "largest", "none"];

/// What holds, and parts of the claims that it holds: a test as `file::name`, a script or a table as its file.
#[rustfmt::skip]
const HELD: &[(&str, &[&str])] = &[
    // How exact it is.
    ("tests/curve/promises.rs::the_pages_have_these_numbers", &[
        "0.5 ulp", "0.69 ulp", "0.85 tick", "0.52 tick", "within 2⁻⁴⁶", "at most 2⁻⁴⁶",
        "hold for `u` from 2⁻²³", "2⁻⁵³ of the interval", "at most 79", "1 ulp | 1 ulp",
        "at most 179 cycles", "`efficiency` | 1 ulp", "falls by at most 1 ulp", "never below 2⁻⁵⁷",
    ]),
    ("tests/curve/promises.rs::aimed_curves", &[
        "never gives an earlier time", "ever decrease", "never overlap", "the same for every number of octaves",
        "always the same", "the same bits with every number", "each pulse sends equal light",
        "Their errors are counted in a larger unit",
    ]),
    ("tests/curve/promises.rs::designs", &["has a promise for every curve"]),
    ("tests/curve/refusals.rs::fractions_and_times_beyond_the_curve", &[
        "is clamped to [0, 1]", "The time of 0 is", "It is 0 before", "The openness at the time", "counts as 0.0",
    ]),
    ("tests/curve/promises.rs::named_curves_and_cases", &["1 divided by the", "efficiency, at most 1"]),
    ("benches/host/speed_vs_error/every_f32.rs", &["checks order and errors at"]),
    ("docs/internals/speed-vs-error.md",
        &["in the repository has the largest", "*Error* is the largest", "with 256 entries, reaches"]),
    // What is accepted.
    ("tests/curve/refusals.rs::each_rule_to_the_adjacent_f32", &[
        "15/16", "has an openness in [0, 1]", "the openness is 1.", "2⁻⁶⁴ to 2⁶⁴", "at least 2⁻¹⁶", "at least 2⁻²⁴",
        "too small by 2⁻⁵³", "at least 2⁻²⁰",
    ]),
    ("tests/curve/refusals.rs::shutteropening_names_what_is_wrong", &["by up to 2⁻²¹", "fraction of the *whole*"]),
    ("src/shutter.rs", &["If `f` exceeds 1"]),
    // Triggers and pulses.
    ("tests/curve/ticks.rs::frames_that_are_refused", &[
        "at most 2²² triggers or pulses", "if the rate is 0", "above 2²²", "more than 2²² places",
        "Both are 1 tick", "and pulses may touch", "With a duty of 1", "may start and end at the same tick",
    ]),
    ("tests/curve/ticks.rs::the_greatest_tick_rate_is_named", &["at most 2³¹", "16-bit"]),
    ("tests/curve/ticks.rs::the_most_that_keep_the_gap", &["below both `wanted` and 2²²", "at most 23 frames"]),
    ("tests/curve/ticks.rs::the_max_triggers_of_anything", &["It is 0 only if `wanted` is 0"]),
    ("tests/curve/ticks.rs::a_filled_schedule_is_each_trigger_alone",
        &["Openness is at most 1, so", "Of these 1.04 ticks", "rounded down with a margin"]),
    ("tests/curve/ticks.rs::direct_frames_are_large", &["127 or more", "Each further octave", "It is 0 if the middle"]),
    ("cli/tests/program/emit.rs::the_command_line_answers_for_one_run", &["none is dimmed"]),
    // What it costs.
    ("tests/curve/ticks.rs::a_curve_has_so_many_bytes", &["368 + 96", "1136 bytes"]),
    ("tests/curve/ticks.rs::a_constant_is_what_run_time_makes", &["Above 16, a constant"]),
    ("benches/cortex-m/src/budget.rs", &["about one fraction in 400", "2.8 million"]),
    ("docs/internals/cost.md", &[
        "about 4.5 kB of flash", "The code for ticks", "60 to 110", "500 to 2500", "34 cycles",
        "`inverse_cdf` of a `static` | 66",
        "careful Newton", "linear table", "square root, only", "mean cycles of a call",
    ]),
    ("benches/cortex-m/src/links.rs", &["Every function returns", "which is never reached"]),
    ("benches/cortex-m/src/answers.rs", &["machine with IEEE arithmetic", "excess precision"]),
    ("src/octave/mod.rs",
        &["`OCTAVES` is at most 64", "An *octave* is", "Above 1/2 the same",
          "widest octaves", "An octave has none", "With 0, every fraction"]),
];

/// No claims: titles, definitions, and what a reader can look up.
#[rustfmt::skip]
const PLAIN: &[&str] = &[
    "have run in emulators only", "from 0 to 1", "take 4 bytes each", "needs Rust 1.88", "half (0.5)",
    "--min-gap 100us", "and never change: emit them", "License: MIT", "what holds for every input",
    "What holds for every input", "A gentle ramp takes", "at every point in time within", "that spans time 0",
    "[docs/firmware.md]", "may need none either", "On longer curves",
    "larger of `|open", "search steps that", "32 ticks of 2³¹",
];

/// The text outside of code, a paragraph, list item or table row a line.
fn blocks(page: &str) -> Vec<String> {
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(page)).unwrap();
    let (mut blocks, mut is_code) = (vec![String::new()], false);
    for line in text.lines().map(str::trim) {
        let line = match page.ends_with(".rs") {
            true => line.strip_prefix("///").or(line.strip_prefix("//!")).unwrap_or_default().trim(),
            false => line,
        };
        is_code ^= line.starts_with("```");
        let starts = ["|", "- ", "#", "![", "```"].iter().any(|mark| line.starts_with(mark));
        if starts || line.is_empty() || blocks.last().is_some_and(|last| last.starts_with(['|', '#'])) {
            blocks.push(String::new());
        }
        if !is_code && !line.starts_with("```") {
            let last = blocks.last_mut().unwrap();
            *last += if last.is_empty() { "" } else { " " };
            *last += line;
        }
    }
    blocks
}

/// Without code and links' targets.
fn words(claim: &str) -> String {
    let prose: String = claim.split('`').step_by(2).collect();
    let texts = prose.split("](").enumerate();
    texts.map(|(i, part)| if i == 0 { part } else { part.split_once(')').unwrap_or(("", part)).1 }).collect()
}

fn is_claim(sentence: &str) -> bool {
    let words = words(sentence).to_lowercase();
    words.contains(|c: char| c.is_numeric()) && words.trim_end_matches(['.', ' ']).parse::<u32>().is_err()
        || WORDS.iter().any(|word| {
            words
                .split(|c: char| !c.is_alphabetic() && c != ' ')
                .any(|part| format!(" {part} ").contains(&format!(" {word} ")))
        })
}

#[test]
fn each_claim_is_held() {
    let mut claims = Vec::new();
    for page in PAGES {
        for block in blocks(page) {
            let block = block.replace(".) ", "). ");
            let sentences = if block.starts_with('|') { vec![&*block] } else { block.split_inclusive(". ").collect() };
            claims.extend(sentences.into_iter().filter(|it| is_claim(it)).map(|it| format!("{page}: {it}")));
        }
    }
    println!("{} claims", claims.len());
    let parts = || HELD.iter().flat_map(|(_, parts)| parts.iter()).chain(PLAIN);
    let open: Vec<_> = claims.iter().filter(|claim| !parts().any(|part| claim.contains(part))).collect();
    assert!(open.is_empty(), "held by nothing: {open:#?}");
    let gone: Vec<_> = parts().filter(|part| !claims.iter().any(|claim| claim.contains(*part))).collect();
    assert!(gone.is_empty(), "claimed no more: {gone:#?}");
    for (holder, _) in HELD {
        let (file, name) = holder.split_once("::").unwrap_or((holder, ""));
        let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file));
        let text = text.unwrap_or_else(|_| panic!("no {file}"));
        assert!(name.is_empty() || text.contains(name), "no {holder}");
    }
}
