//! The variants of a study: values of parameters, row by row.

use super::points::Sample;
use crate::error::{Error, Result};
use crate::study::numbers::Numbers;
use crate::sweep::Range;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::str::FromStr;

/// A parameter with its range, and with the number of its values where that is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The range.
    pub range: Range,
    /// True if the number of values is given.
    pub is_counted: bool,
}

impl FromStr for Axis {
    type Err = Error;

    fn from_str(text: &str) -> Result<Axis> {
        let range = text.parse()?;
        let is_counted = text.split(':').nth(1).is_some_and(|part| part.trim() != "log");
        Ok(Axis { range, is_counted })
    }
}

/// The variants of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The variants in words: ranges, sample and seed, or a hash of a list.
    pub words: String,
    /// Names of the parameters.
    pub names: Vec<String>,
    /// Their values, a row for each variant.
    pub rows: Vec<Vec<f64>>,
}

/// More variants than this are taken for a mistake.
const MOST: usize = 10_000_000;

impl Plan {
    /// All combinations of the values of ranges; those of the last parameter change fastest.
    ///
    /// # Errors
    /// A range without a number of values; too many variants; a parameter twice.
    pub fn grid(axes: &[Axis]) -> Result<Plan> {
        if let Some(axis) = axes.iter().find(|axis| !axis.is_counted) {
            let Range { parameter, from, to, .. } = &axis.range;
            return Err(Error::input(format!("`{parameter}` has no number of values"))
                .hint(format!("write {parameter}={from}..{to}:N, or give --sample latin:N")));
        }
        let count = axes.iter().fold(1usize, |count, axis| count.saturating_mul(axis.range.count));
        refuse(count)?;
        let values: Vec<Vec<f64>> = axes.iter().map(|axis| axis.range.values()).collect();
        let row = |mut index: usize| {
            let mut row = vec![0.0; values.len()];
            for (value, known) in row.iter_mut().zip(&values).rev() {
                *value = known[index % known.len()];
                index /= known.len();
            }
            row
        };
        Plan::new(words(axes), axes, (0..count).map(row).collect())
    }

    /// Points of a sample in the box of the ranges.
    ///
    /// # Errors
    /// A range with a number of values; too many variants or parameters; a parameter twice.
    pub fn sample(axes: &[Axis], sample: Sample, seed: u64) -> Result<Plan> {
        if let Some(axis) = axes.iter().find(|axis| axis.is_counted) {
            let Range { parameter, count, .. } = &axis.range;
            return Err(Error::input(format!(
                "`{parameter}` has {count} values, and --sample says how many there are"
            ))
            .hint(format!("leave out `:{count}`")));
        }
        refuse(sample.count)?;
        let points = sample.points(axes.len(), seed).map_err(|error| error.under("--sample"))?;
        let place = |(range, u): (&Range, f64)| {
            if range.is_log {
                range.from * (range.to / range.from).powf(u)
            } else {
                range.from * (1.0 - u) + range.to * u
            }
        };
        let rows = points.into_iter().map(|point| axes.iter().map(|axis| &axis.range).zip(point).map(place).collect());
        let name = format!("{:?}", sample.filling).to_lowercase();
        Plan::new(format!("{name}:{} seed {seed}, {}", sample.count, words(axes)), axes, rows.collect())
    }

    /// The rows of a table, whose headings are the parameters.
    ///
    /// # Errors
    /// A file that cannot be read or is no table of numbers; a heading twice.
    pub fn list(path: &Path) -> Result<Plan> {
        let hint = "give comma-separated values with the names of parameters as headings";
        let text = crate::files::read_text(path).map_err(|error| Error::file(path, error))?;
        let Numbers { headings, rows } = Numbers::parse(&text).map_err(|error| error.hint(hint).in_file(path))?;
        if rows.is_empty() {
            return Err(Error::file(path, "there are no rows").hint(hint));
        }
        refuse(rows.len())?;
        let mut hash = DefaultHasher::new();
        rows.iter().flatten().for_each(|value| value.to_bits().hash(&mut hash));
        let words =
            format!("a list of {} variants of {}, hash {:016x}", rows.len(), headings.join(", "), hash.finish());
        Plan { words, names: headings, rows }.checked()
    }

    fn new(words: String, axes: &[Axis], rows: Vec<Vec<f64>>) -> Result<Plan> {
        Plan { words, names: axes.iter().map(|axis| axis.range.parameter.clone()).collect(), rows }.checked()
    }

    fn checked(self) -> Result<Plan> {
        let names = &self.names;
        match (0..names.len()).find(|&i| names[..i].contains(&names[i])) {
            None => Ok(self),
            Some(i) => Err(Error::input(format!("the parameter `{}` is varied twice", names[i]))
                .hint("give each parameter one range")),
        }
    }
}

fn words(axes: &[Axis]) -> String {
    let word = |Axis { range, is_counted }: &Axis| {
        let spacing = if range.is_log { ":log" } else { "" };
        let uncounted = || format!("{}={}..{}{spacing}", range.parameter, range.from, range.to);
        if *is_counted { range.to_string() } else { uncounted() }
    };
    axes.iter().map(word).collect::<Vec<_>>().join(" ")
}

fn refuse(count: usize) -> Result<()> {
    if count <= MOST {
        return Ok(());
    }
    Err(Error::input(format!("there are {count} variants; give up to {MOST}"))
        .hint("take fewer values, or --sample latin:N"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axes(texts: &[&str]) -> Vec<Axis> {
        texts.iter().map(|text| text.parse().unwrap()).collect()
    }

    #[test]
    fn a_grid_has_all_combinations() {
        let plan = Plan::grid(&axes(&["a=1..2:2", "b=10..1000:3:log"])).unwrap();
        assert_eq!((plan.names.as_slice(), plan.rows.len()), (&["a".to_string(), "b".to_string()][..], 6));
        assert_eq!((plan.rows[0].as_slice(), plan.rows[5].as_slice()), (&[1.0, 10.0][..], &[2.0, 1000.0][..]));
        assert!((plan.rows[1][1] - 100.0).abs() < 1e-12 && plan.rows[3][0] == 2.0);
    }

    #[test]
    fn a_sample_lies_in_its_ranges() {
        let plan = Plan::sample(&axes(&["a=-1..3", "b=1..100:log"]), "latin:100".parse().unwrap(), 1).unwrap();
        assert!(plan.rows.iter().all(|row| (-1.0..3.0).contains(&row[0]) && (1.0..100.0).contains(&row[1])));
        // Of a constant factor half of the values lie below the geometric mean.
        assert_eq!(plan.rows.iter().filter(|row| row[1] < 10.0).count(), 50);
    }

    #[test]
    fn bad_plans_are_told() {
        let said = |plan: Result<Plan>| plan.unwrap_err().to_string();
        let latin = "latin:5".parse().unwrap();
        assert!(said(Plan::grid(&axes(&["a=1..2"]))).starts_with("`a` has no number of values"));
        assert!(said(Plan::grid(&axes(&["a=1..2:9", "a=1..3:2"]))).starts_with("the parameter `a` is varied twice"));
        assert!(said(Plan::grid(&axes(&["a=1..2:9999", "b=1..3:9999"]))).starts_with("there are 99980001 variants"));
        assert!(said(Plan::sample(&axes(&["a=1..2:9"]), latin, 1)).starts_with("`a` has 9 values"));
    }
}
