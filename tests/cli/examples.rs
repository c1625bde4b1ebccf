//! The examples of every `--help`, completions and manual pages.

use super::*;

fn commands(place: &Place) -> Vec<String> {
    let help = place.done(&["--help"]);
    let list = help.split("Commands:\n").nth(1).unwrap().split("\n\n").next().unwrap();
    let names = list.lines().filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
    names.filter(|name| !name.is_empty() && *name != "help").map(str::to_string).collect()
}

#[test]
fn every_example_of_every_help_runs() {
    let place = Place::new("");
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("models");
    fs::create_dir(place.path("models")).unwrap();
    fs::create_dir(place.path("models/data")).unwrap();
    let data = files(&models.join("data")).into_iter().map(|name| format!("data/{name}"));
    for name in files(&models).into_iter().filter(|name| name != "data").chain(data) {
        fs::copy(models.join(&name), place.path("models").join(&name)).unwrap();
    }
    let names = commands(&place);
    assert!(names.len() > 15, "{names:?}");
    for name in names {
        let help = place.done(&[&name, "--help"]);
        let examples = help.split("Examples:\n").nth(1).unwrap_or_else(|| panic!("{name} has no examples"));
        let examples: Vec<&str> = examples.lines().filter_map(|line| line.trim().strip_prefix("holonom ")).collect();
        assert_eq!(examples.len(), 2, "{name}");
        for example in examples {
            let words: Vec<&str> = example.split(" > ").next().unwrap().split(' ').collect();
            assert_eq!(words[0], name);
            assert!(!place.done(&words).is_empty() || example.contains(" -o "), "{example} says nothing");
        }
    }
}

#[test]
fn shells_complete_every_command() {
    let place = Place::new("");
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = place.done(&["completions", shell]);
        commands(&place).iter().for_each(|name| assert!(script.contains(name.as_str()), "{shell}: {name}"));
        assert!(script.contains("output-step"), "{shell}");
    }
}

#[test]
fn every_command_has_a_page() {
    let place = Place::new("");
    place.done(&["man", "-o", "man"]);
    let pages = commands(&place).into_iter().map(|name| format!("holonom-{name}.1"));
    let mut expected: Vec<String> = pages.chain(["holonom.1".to_string()]).collect();
    expected.sort();
    assert_eq!(place.files("man"), expected);
    let page = place.text("man/holonom-simulate.1");
    assert!(page.contains(".TH holonom-simulate 1") && page.contains("holonom simulate models/andrews.json"), "{page}");
    assert_eq!(place.done(&["man"]), place.text("man/holonom.1"));
}
