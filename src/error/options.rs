//! Options of the command line as settings.

/// Options whose value is a name.
const NAMED: [&str; 7] = ["chart", "figures", "format", "formulation", "integrator", "method", "projection"];

/// The text with settings in the place of options: `` `output_step = 0.1` `` for `--output-step 0.1`. A quoted command,
/// which begins with `holonom`, keeps its options.
pub(crate) fn as_settings(text: &str) -> String {
    let parts = text.split('`').enumerate().map(|(i, part)| match i % 2 {
        1 if part.starts_with("holonom ") => part.to_string(),
        1 => renamed(part, ""),
        _ => renamed(part, "`"),
    });
    parts.collect::<Vec<_>>().join("`")
}

/// The name of a setting for an option alone, such as the path of an error: `output_step` for `--output-step`.
pub(crate) fn as_setting(path: &str) -> String {
    path.strip_prefix("--").map_or_else(|| path.to_string(), |name| name.replace('-', "_"))
}

/// The words with settings between marks.
fn renamed(text: &str, mark: &str) -> String {
    let mut found: Vec<String> = Vec::new();
    let mut words = text.split(' ').peekable();
    let mut follows_value = false;
    while let Some(word) = words.next() {
        let Some((before, name, after)) = option(word) else {
            found.push(word.to_string());
            follows_value = false;
            continue;
        };
        if let (true, Some(last)) = (follows_value, found.last_mut()) {
            last.push(',');
        }
        let mark = if before.ends_with(QUOTES) { "" } else { mark };
        let mut setting = name.replace('-', "_");
        let value = words.next_if(|next| after.is_empty() && takes(name, next));
        let (value, after) = value.map_or(("", after), |value| value.split_at(value.trim_end_matches(ENDS).len()));
        if !value.is_empty() {
            setting += &format!(" = {value}");
        }
        follows_value = !value.is_empty() && after.is_empty();
        found.push(format!("{before}{mark}{setting}{mark}{after}"));
    }
    found.join(" ")
}

const QUOTES: [char; 2] = ['\'', '"'];

/// Characters that end a value in a sentence.
const ENDS: [char; 5] = [',', ';', ':', '.', ')'];

/// The parts of a word that is an option: what stands before it, its name and what follows.
fn option(word: &str) -> Option<(&str, &str, &str)> {
    let at = word.find("--")?;
    let (before, rest) = (&word[..at], &word[at + 2..]);
    let is_start = before.chars().all(|c| "('\"\n".contains(c)) && rest.starts_with(|c: char| c.is_ascii_lowercase());
    let end = rest.find(|c: char| !c.is_ascii_lowercase() && c != '-').unwrap_or(rest.len());
    is_start.then(|| (before, &rest[..end], &rest[end..]))
}

/// True if the next word is the value of an option, such as `0.1`, `T`, or `mcs` of a method.
fn takes(name: &str, next: &str) -> bool {
    let is_option = next.starts_with("--");
    let is_number = next.starts_with(|c: char| c.is_ascii_digit() || c.is_ascii_uppercase());
    !is_option && !next.is_empty() && (is_number || next.contains(':') || NAMED.contains(&name))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_become_settings() {
        let table = [
            ("give --until T, or \"t_end\" in", "give `until = T`, or \"t_end\" in"),
            (
                "give --output-step a part of it, or --until a later end",
                "give `output_step` a part of it, or `until` a later end",
            ),
            ("by --budget 20s, or values by --reference FILE", "by `budget = 20s`, or values by `reference = FILE`"),
            ("take --method mcs, or another time", "take `method = mcs`, or another time"),
            ("`--method auto` chooses", "`method = auto` chooses"),
            ("`--again` prints how", "`again` prints how"),
            (
                "an implicit method: --formulation ggl --integrator radau_iia --projection none",
                "an implicit method: `formulation = ggl`, `integrator = radau_iia`, `projection = none`",
            ),
            ("dop853; --check-error measures errors", "dop853; `check_error` measures errors"),
            ("give --rtol and --atol", "give `rtol` and `atol`"),
            ("(choose by --input and --output)", "(choose by `input` and `output`)"),
            ("`holonom check --static` shows it", "`holonom check --static` shows it"),
            ("argument '--untill' found", "argument 'untill' found"),
            ("take fewer values, or --sample latin:N", "take fewer values, or `sample = latin:N`"),
            ("a -- b, x--y, ---", "a -- b, x--y, ---"),
            ("", ""),
        ];
        for (option, setting) in table {
            assert_eq!(as_settings(option), setting);
        }
        assert_eq!((as_setting("--output-step"), as_setting("joints[0]")), ("output_step".into(), "joints[0]".into()));
    }
}
