//! README and the chapters of the guide: every command and file in them works as they say, and the language is plain.

mod blocks;
mod facts;
#[cfg(unix)]
mod machines;
mod sentences;

use blocks::{commands, follow};
use holonom::guide::CHAPTERS;
use std::path::Path;

fn text(name: &str) -> &'static str {
    CHAPTERS.iter().find(|chapter| chapter.name == name).unwrap_or_else(|| panic!("no chapter {name}")).text
}

fn readme() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")).unwrap()
}

/// A test for each chapter, and one that there are no others.
macro_rules! chapters {
    ($($name:ident)*) => {
        $(#[test]
        fn $name() {
            follow(text(stringify!($name)));
        })*

        #[test]
        fn every_chapter_is_followed() {
            let names: Vec<&str> = CHAPTERS.iter().map(|chapter| chapter.name).collect();
            assert_eq!(names, [$(stringify!($name)),*]);
        }
    };
}

chapters! {
    tutorial loops scenes expressions methods stabilization accuracy kinematics studies linear flexible speed extremes
    simplify singular events results view troubleshooting rust python large gallery references changelog
}

#[test]
fn the_readme() {
    assert!(follow(&readme()) >= 2);
}

#[test]
fn chapters_are_printed() {
    let list = commands("holonom guide");
    for chapter in CHAPTERS {
        assert!(list.contains(&format!("{:<16} {}", chapter.name, chapter.title())), "{list}");
        let printed = commands(&format!("holonom guide {}", chapter.name));
        assert!(printed.starts_with("# ") && !printed.contains("]: "), "{}", chapter.name);
    }
}

/// Links of chapters name files that are there, and every target in `links.txt` is a chapter.
#[test]
fn links_lead_to_chapters() {
    let targets = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/guide/links.txt")).unwrap();
    for chapter in CHAPTERS {
        for line in chapter.text.lines().filter(|line| line.starts_with('[') && line.contains("]: ")) {
            let (name, file) = line[1..].split_once("]: ").unwrap();
            let file = file.split('#').next().unwrap();
            assert!(CHAPTERS.iter().any(|known| format!("{}.md", known.name) == file), "{}: {line}", chapter.name);
            assert!(targets.contains(&format!("[{name}]: crate::guide::")), "links.txt has no {name}");
        }
    }
}

/// The files that `![...](...)` and `src="..."` show, from a folder.
fn pictures(text: &str, folder: &str) -> Vec<std::path::PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let named = text.split("](").skip(1).filter_map(|rest| rest.split(')').next());
    let tags = text.split("src=\"").skip(1).filter_map(|rest| rest.split('"').next());
    let is_picture = |file: &&str| [".png", ".gif", ".svg"].iter().any(|ending| file.ends_with(ending));
    named.chain(tags).filter(is_picture).map(|file| root.join(file)).collect()
}

#[test]
fn pictures_are_there() {
    let mut shown = pictures(&readme(), "");
    assert!(shown.len() >= 6, "{shown:?}");
    shown.extend(CHAPTERS.iter().flat_map(|chapter| pictures(chapter.text, "src/guide")));
    for file in shown {
        assert!(file.is_file(), "{}", file.display());
    }
}

#[test]
fn the_gallery_shows_each_of_its_mechanisms() {
    let gallery = text("gallery");
    assert_eq!(pictures(gallery, "src/guide").len(), gallery.matches("\n## ").count());
}
