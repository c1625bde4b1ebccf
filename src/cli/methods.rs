//! `holonom methods`

use super::common::print_result;
use crate::error::Result;
use crate::integrator::{self, IntegratorEntry};
use crate::method_spec::{MethodSpec, OptionDoc};
use crate::report::TextTable;
use crate::simulate::check_pair;
use crate::{formulation, projection};
use serde::Serialize;
use serde_json::{Value, json};

#[derive(clap::Args)]
#[command(after_help = "Examples:
  holonom methods
  holonom methods --integrator radau_iia")]
pub struct Args {
    /// Only what goes with this formulation
    #[arg(long, value_name = "NAME")]
    formulation: Option<String>,
    /// Only what goes with this integrator
    #[arg(long, value_name = "NAME")]
    integrator: Option<String>,
    /// Print as JSON
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct MethodItem {
    name: &'static str,
    about: &'static str,
    r#for: &'static str,
    options: &'static [OptionDoc],
}

pub fn run(args: Args) -> Result<()> {
    let pairs = pairs(&args)?;
    print_result(args.json, &json(&pairs), || text(&pairs))
}

type MethodPair = (&'static IntegratorEntry, &'static str);

/// Returns integrators with the formulations that they accept, of the requested ones.
fn pairs(args: &Args) -> Result<Vec<MethodPair>> {
    let wanted = |name: &Option<String>| name.as_deref().map(MethodSpec::parse).transpose();
    let formulation = wanted(&args.formulation)?;
    let integrator = wanted(&args.integrator)?;
    if let Some(spec) = &formulation {
        spec.entry::<formulation::FormulationEntry>().map_err(|error| error.under("--formulation"))?;
    }
    if let Some(spec) = &integrator {
        let entry = integrator::find(spec).map_err(|error| error.under("--integrator"))?;
        formulation.iter().try_for_each(|formulation| check_pair(entry, formulation))?;
    }
    let is_wanted = |spec: &Option<MethodSpec>, name: &str| spec.as_ref().is_none_or(|spec| spec.name == name);
    let entries = integrator::registry().iter().filter(|entry| is_wanted(&integrator, entry.name));
    let pairs = entries.flat_map(|entry| entry.accepts().map(move |name| (entry, name)));
    Ok(pairs.filter(|(_, name)| is_wanted(&formulation, name)).collect())
}

fn lists(pairs: &[MethodPair]) -> [(&'static str, Vec<MethodItem>); 3] {
    let item = |name, about, options| MethodItem { name, about, r#for: purpose(name), options };
    let formulations = formulation::registry().iter().filter(|entry| pairs.iter().any(|pair| pair.1 == entry.name));
    let integrators = integrator::registry().iter().filter(|entry| pairs.iter().any(|pair| pair.0.name == entry.name));
    let projections = projection::registry().iter();
    [
        ("formulations", formulations.map(|entry| item(entry.name, entry.about, entry.options)).collect()),
        ("integrators", integrators.map(|entry| item(entry.name, entry.about, entry.options)).collect()),
        ("projections", projections.map(|entry| item(entry.name, entry.about, entry.options)).collect()),
    ]
}

/// Returns the methods, and the accepted triples with their proven orders.
fn json(pairs: &[MethodPair]) -> Value {
    let triples = pairs.iter().flat_map(|&(entry, formulation)| {
        let accepted = projection::registry().iter().filter(move |other| !entry.refuses(formulation, other.name));
        accepted.map(move |projection| {
            json!({
                "formulation": formulation,
                "integrator": entry.name,
                "projection": projection.name,
                "q": entry.order,
                "v": entry.order,
                "lambda": entry.order,
            })
        })
    });
    let lists = lists(pairs).into_iter().map(|(heading, items)| (heading.to_string(), json!(items)));
    lists.chain([("triples".to_string(), triples.collect())]).collect()
}

fn text(pairs: &[MethodPair]) -> String {
    let mut text = "A method is a formulation x an integrator x a projection.\n\n".to_string();
    text += &orders(pairs);
    text += "\nOrders in q, v and lambda, each a test; one number where they agree; - where the projection would cost an \
             order\nand is refused. With penalty they are those of the approach to the motion that the penalty leaves.\n";
    if pairs.iter().any(|(entry, _)| entry.follows_fields()) {
        let fields = fields();
        let (first, rest) = fields.split_at(5);
        text += &format!("Vector fields are {},\n{}.\n", first.join(", "), rest.join(", "));
    }
    for (heading, items) in lists(pairs) {
        text += &format!("\n{}", list(heading, &items));
    }
    text + "\nWrite options as baumgarte:alpha=5,beta=5. `--method auto` chooses on the way and says why.\n"
}

/// Returns the formulations that explicit methods can integrate.
fn fields() -> Vec<&'static str> {
    formulation::registry().iter().filter(|entry| entry.field.is_some()).map(|entry| entry.name).collect()
}

/// Returns one row for the formulations of an integrator that have the same orders with every projection.
fn orders(pairs: &[MethodPair]) -> String {
    let names = projection::registry().iter().map(|entry| entry.name);
    let headings: Vec<&str> = ["integrator", "formulation"].into_iter().chain(names).collect();
    let mut table = TextTable::left(&headings);
    for of_one in pairs.chunk_by(|a, b| a.0.name == b.0.name) {
        let mut rows: Vec<(Vec<String>, Vec<&str>)> = Vec::new();
        for &(entry, formulation) in of_one {
            let cells = cells(entry, formulation);
            match rows.iter_mut().find(|row| row.0 == cells) {
                Some(row) => row.1.push(formulation),
                None => rows.push((cells, vec![formulation])),
            }
        }
        for (i, (cells, formulations)) in rows.into_iter().enumerate() {
            let name = if i == 0 { of_one[0].0.name } else { "" };
            let with = if formulations == fields() { "vector fields".to_string() } else { formulations.join(" ") };
            table.row([name.to_string(), with].into_iter().chain(cells));
        }
    }
    table.to_string()
}

fn cells(entry: &IntegratorEntry, formulation: &str) -> Vec<String> {
    let cell = |projection: &str| {
        if entry.refuses(formulation, projection) { "-".to_string() } else { entry.order.to_string() }
    };
    projection::registry().iter().map(|entry| cell(entry.name)).collect()
}

/// Returns description and purpose of each, with its options as they are written.
fn list(heading: &str, items: &[MethodItem]) -> String {
    let mut text = format!("{heading}\n");
    for MethodItem { name, about, r#for, options } in items {
        let options: Vec<String> = options.iter().map(|option| format!("{}=..", option.name)).collect();
        let colon = if options.is_empty() { "" } else { ":" };
        text += &format!("  {name}{colon}{}\n      {about}\n      for {for}\n", options.join(","));
    }
    text
}

/// Returns the purpose of a formulation, an integrator or a projection by its name. Empty for an unknown name, which a
/// test refuses.
fn purpose(name: &str) -> &'static str {
    match name {
        "index1" => "almost every motion: the cheapest step; give it a projection",
        "index2" => "half-explicit methods: velocities that hold, and reactions without second derivatives of phi",
        "index3" => "structural dynamics, and implicit methods that damp what is fast",
        "ggl" => "stiff motions that must keep both constraints without a projection",
        "stabilized_index1" => "the same with reactions that are free of what a step leaves along the constraints",
        "baumgarte" => "real time with fixed steps, and comparison with older codes; gains about 1/h",
        "invariant_manifold" => "fixed steps, and studies of how fast an error should decay",
        "force_projection" => "control: forces and constraint errors apart, no gain in the forces themselves",
        "penalty" => "singular positions and redundant joints where three or four digits do",
        "augmented_lagrangian" => "the same with more digits",
        "udwadia_kalaba" => "a check by another way to lambda, redundant rows included; small systems",
        "null_space" => "small systems with few degrees of freedom: no drift, fewest states, no gains to choose",
        "heun" => "tests, and constraints or forces that are not smooth",
        "rk4" => "fixed steps where nothing is stiff: real time, comparison with other codes",
        "dopri5" => "three to five digits where nothing is stiff",
        "dop853" => "five digits to round-off where nothing is stiff: the first choice",
        "adams" => "smooth motions of mechanisms whose equations are costly, five digits to round-off; few events",
        "hem3" => "fixed steps at low accuracy with exact velocity constraints",
        "hem4" => "the same at medium accuracy",
        "hem5" => "the same at high accuracy",
        "phem56" => "tight tolerances with exact velocity constraints",
        "radau_iia" => "stiff motions at any accuracy, also fast oscillations that are at rest",
        "rattle" => "long motions without loss, where the energy must not drift; M constant",
        "generalized_alpha" => "the slow motion of stiff structures, whose fast oscillations it damps",
        "ali3p" => "redundant constraints, and motions through singular positions",
        "bdf" => "smooth and damped stiff motions over long times",
        "tr_bdf2" => "stiff motions at two or three digits",
        "esdirk34" => "stiff motions at three to five digits, oscillating ones too",
        "tsit45" => "a second opinion on explicit methods, with which it shares no code",
        "diffsol" => "a second opinion on implicit methods, with which it shares no code",
        "none" => "formulations that hold phi and phi' themselves, and to see how far the others drift",
        "position" => "loops that must close while velocities are someone else's",
        "velocity" => "velocities that must fit while small gaps do not matter",
        "manifold" => "every run: both levels for one factorization",
        "full" => "long runs at coarse steps, where second derivatives pay",
        "exact" => "references, and both constraints at round-off",
        _ => "",
    }
}
