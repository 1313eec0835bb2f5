//! What the name of a column says: is it the time, does it count, and in which unit.

use crate::unit::Unit;

/// What a name says of the unit of time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Said {
    Nothing,
    Unit(Unit),
    /// A unit and something more, as `tenths of ms`, or one that is not read, as `min`.
    Unclear,
}

const UNITS: [(Unit, &str); 4] = [
    (Unit::Second, "s sec second seconds secs sek sekunden"),
    (Unit::Millisecond, "ms msec msecs millis millisec millisecond milliseconds"),
    (Unit::Microsecond, "us µs μs \u{fffd}s usec usecs micros microsec microsecond microseconds"),
    (Unit::Nanosecond, "ns nsec nsecs nanos nanosecond nanoseconds"),
];
/// Units of time that are not read.
const OTHER_UNITS: &str = "min mins minutes h hr hours d days ps picoseconds div";
/// What makes another number of a unit.
const FACTORS: &str = "ten tens tenth tenths hundred hundreds hundredth hundredths thousand thousandths half halves \
     quarter quarters deci centi per div sample";
const TIMES: &str =
    "time times t timestamp elapsed timer zeit temps tiempo tempo tid tijd czas aika millis micros seconds";
/// These may stand beside one of the former.
const BESIDE_TIMES: &str = "stamp since start trigger boot fractional axis x rel relative abs absolute in of the";
const COUNTS: &str =
    "sample samples index idx n no nr num number point points sequence seq i count counter row tick ticks";
const SIGNALS: &str = "v mv uv µv kv volt volts mvolt mvolts millivolts a ma ua amp amps ampere w lx lux % db dbv code \
     adc raw value logic sequence ampl unknown";

/// Is the word one of the list's?
pub fn has(list: &str, word: &str) -> bool {
    list.split(' ').any(|known| known == word)
}

/// The unit that a word is the name of.
pub fn unit_of(word: &str) -> Option<Unit> {
    UNITS.iter().find(|(_, names)| has(names, word)).map(|(unit, _)| *unit)
}

pub fn words(text: &str) -> Vec<String> {
    let is_part = |c: char| c.is_alphanumeric() || c == char::REPLACEMENT_CHARACTER;
    let words = text.split(|c| !is_part(c)).filter(|word| !word.is_empty());
    words.map(str::to_lowercase).collect()
}

/// A name's words outside of its brackets, and what stands in these.
fn parts(name: &str) -> (Vec<String>, Vec<String>) {
    let name = name.split(' ').filter(|word| !is_path(word)).collect::<Vec<_>>().join(" ").to_lowercase();
    let parts = name.split([')', ']', '}']).map(|part| part.split_once(['(', '[', '{']).unwrap_or((part, "")));
    let (outside, inside): (Vec<&str>, Vec<&str>) = parts.unzip();
    (words(&outside.join(" ")), inside.iter().map(|text| text.trim().into()).collect())
}

/// Is it a file's name behind folders, whose letters are no units?
fn is_path(word: &str) -> bool {
    let mut parts = word.split(['/', '\\']);
    parts.next_back().is_some_and(|last| parts.next().is_some() && (last.contains('.') || parts.next().is_some()))
}

fn is_number(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_digit())
}

/// The unit of time in the name of a column: alone in brackets, or a word of the name; with a factor it is unclear.
pub fn unit_in(name: &str) -> Said {
    let (outside, inside) = parts(name);
    // `10us` is no word for a unit, and `x10` makes another one of it.
    let bare = |word: &str| unit_of(word.trim_start_matches(|c: char| c.is_ascii_digit()));
    let is_times = |word: &String| word.strip_prefix('x').is_some_and(is_number);
    // `TimeMs` and `tms`, but not `ts`, which is a time stamp.
    let short = |word: &String| {
        let unit = word.strip_prefix("time").or_else(|| word.strip_prefix('t'))?;
        unit_of(unit).filter(|_| unit.len() > 1)
    };
    let in_brackets = inside.iter().find_map(|text| unit_of(text));
    let in_words = outside.iter().rev().find_map(|word| unit_of(word).or_else(|| short(word)));
    let other = |word: &String| bare(word).is_some() || has(OTHER_UNITS, word);
    let is_factor = |word: &String| has(FACTORS, word) || is_number(word);
    let multiplied = name.contains(['*', '×']) || outside.iter().any(is_times);
    let is_scale = outside.iter().any(|word| has("div per", word));
    // In a sentence a unit is another thing's.
    let is_sentence = name.trim().contains(' ') && !outside.iter().all(|word| may_name_time(word));
    match in_brackets.or(in_words) {
        Some(_) if in_brackets.is_some() && (multiplied || is_scale) => Said::Unclear,
        Some(unit) if in_brackets.is_some() => Said::Unit(unit),
        _ if inside.iter().any(|text| words(text).iter().any(other)) => Said::Unclear,
        _ if is_sentence || outside.iter().any(|word| has(SIGNALS, word)) => Said::Nothing,
        Some(_) if multiplied || outside.iter().any(is_factor) => Said::Unclear,
        Some(unit) => Said::Unit(unit),
        None if outside.iter().any(other) => Said::Unclear,
        None => Said::Nothing,
    }
}

/// May the word stand in the name of a time?
fn may_name_time(word: &str) -> bool {
    let is_listed = [TIMES, BESIDE_TIMES, FACTORS, OTHER_UNITS].iter().any(|list| has(list, word));
    is_listed || unit_of(word).is_some() || is_number(word) || word.strip_prefix('x').is_some_and(is_number)
}

/// Is it the name of a time, and of nothing else, as an exposure's time would be?
pub fn is_time(name: &str) -> bool {
    let (words, _) = parts(name);
    words.iter().any(|word| has(TIMES, word)) && words.iter().all(|word| may_name_time(word))
}

/// Is it the name of a horizontal axis?
pub fn is_axis(name: &str) -> bool {
    let (words, _) = parts(name);
    words.first().is_some_and(|word| word == "x") && words[1..].iter().all(|word| has("axis value values data", word))
}

/// Is it the name of a number of samples?
pub fn is_count(name: &str) -> bool {
    let (words, _) = parts(name);
    !words.is_empty() && words.iter().all(|word| has(COUNTS, word))
}

/// Is it a unit alone, as in a row of units below the names?
pub fn is_unit(field: &str) -> bool {
    let field = field.trim().trim_matches(['(', ')', '[', ']', '{', '}']).trim().to_lowercase();
    unit_of(&field).is_some() || has(SIGNALS, &field)
}
