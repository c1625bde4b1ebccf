use super::*;

#[test]
fn generated_scenes_check_and_run() {
    for (name, n, freedom) in
        [("chain", 1, 1), ("chain", 5, 5), ("n_four_bar", 1, 1), ("n-four-bar", 4, 1), ("flexible-chain", 2, 26)]
    {
        let place = Place::new("");
        let n = n.to_string();
        place.done(&["generate", name, "--n", &n, "-o", "made.json"]);
        assert_eq!(place.done(&["generate", name, "--n", &n]), place.text("made.json"));
        let check: Value = serde_json::from_str(&place.done(&["check", "made.json", "--json"])).unwrap();
        assert_eq!(check["degrees_of_freedom"], freedom, "{name} {n}");
        place.done(&["simulate", "made.json", "--until", "0.1", "--quiet"]);
        assert!(place.files(&format!("out/{}_{n}", name.replace('-', "_"))).contains(&"summary.json".to_string()));
    }
}

#[test]
fn ten_is_the_number_where_none_is_given() {
    let place = Place::new("");
    assert_eq!(place.done(&["generate", "chain"]), place.done(&["generate", "chain", "--n", "10"]));
}
