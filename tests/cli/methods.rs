//! `holonom methods`: the registries as a table.

use super::*;

#[test]
fn every_name_and_its_orders_are_there() {
    let text = Place::new("").done(&["methods"]);
    for word in ["index1", "baumgarte", "ggl", "heun", "dop853", "radau_iia", "generalized_alpha", "manifold", "exact"]
    {
        assert!(text.contains(word), "{word}");
    }
    let row = |name: &str| {
        let line = text.lines().find(|line| line.trim_start().starts_with(name)).unwrap_or_default();
        line.split_whitespace().map(str::to_string).collect::<Vec<_>>()
    };
    assert_eq!(row("dop853"), ["dop853", "vector", "fields", "8", "8", "8", "8", "8", "8"]);
    assert_eq!(row("bdf")[1..], ["index1", "ggl", "stabilized_index1", "baumgarte", "5", "-", "-", "-", "-", "-"]);
}

#[test]
fn the_table_fits_a_terminal() {
    let text = Place::new("").done(&["methods"]);
    for line in text.lines() {
        assert!(line.chars().count() <= 120 && line.trim_end() == line, "{line}");
    }
}

#[test]
fn filters_leave_what_goes_together() {
    let place = Place::new("");
    let text = place.done(&["methods", "--integrator", "generalized-alpha"]);
    assert!(text.contains("index3") && !text.contains("dop853") && !text.contains("baumgarte:alpha=.."), "{text}");
    let text = place.done(&["methods", "--formulation", "index2"]);
    assert!(text.contains("phem56") && !text.contains("rattle") && !text.contains("Vector fields"), "{text}");
}

#[test]
fn json_names_every_accepted_triple_with_its_orders() {
    let json: Value = serde_json::from_str(&Place::new("").done(&["methods", "--json"])).unwrap();
    assert_eq!(keys(&json), ["formulations", "integrators", "projections", "triples"]);
    for kind in ["formulations", "integrators", "projections"] {
        for item in json[kind].as_array().unwrap() {
            assert_eq!(keys(item), ["name", "about", "for", "options"]);
            assert!(!item["for"].as_str().unwrap().is_empty(), "{item}");
        }
    }
    let triples = json["triples"].as_array().unwrap();
    let of = |f: &str, i: &str, p: &str| {
        triples.iter().find(|t| t["formulation"] == f && t["integrator"] == i && t["projection"] == p)
    };
    let orders = |triple: Option<&Value>| triple.map(|t| [&t["q"], &t["v"], &t["lambda"]].map(|x| x.as_u64().unwrap()));
    assert_eq!(orders(of("index1", "dop853", "manifold")), Some([8, 8, 8]));
    assert_eq!(orders(of("index1", "bdf", "manifold")), None);
    assert_eq!(orders(of("index1", "rattle", "none")), None);
}

#[test]
fn what_does_not_go_together_names_what_does() {
    let place = Place::new("");
    for (args, words) in [
        (&["methods", "--integrator", "rattle", "--formulation", "ggl"][..], "rattle accepts index3"),
        (&["methods", "--integrator", "dopri"], "did you mean `dopri5`?"),
        (&["methods", "--formulation", "zzz"], "choose one of index1"),
    ] {
        let output = place.run(args);
        assert_eq!((output.status.code(), out(&output).as_str()), (Some(2), ""));
        assert!(err(&output).contains(words), "{}", err(&output));
    }
}
