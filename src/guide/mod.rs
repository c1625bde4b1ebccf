//! The guide: chapters that explain how to model, simulate, linearize and judge the results.
//!
//! `holonom guide` lists them in a terminal, and `holonom guide CHAPTER` prints one.

/// A chapter.
#[doc(hidden)]
pub struct Chapter {
    /// Name of its file and module.
    pub name: &'static str,
    /// Its text, Markdown.
    pub text: &'static str,
}

impl Chapter {
    /// Its title.
    pub fn title(&self) -> &'static str {
        self.text.lines().next().unwrap_or_default().trim_start_matches("# ")
    }

    /// Its text without the targets of links at its end.
    pub fn body(&self) -> String {
        let is_target = |line: &&str| line.starts_with('[') && line.contains("]: ");
        self.text.lines().filter(|line| !is_target(line)).collect::<Vec<_>>().join("\n").trim_end().to_string() + "\n"
    }
}

/// Declares each chapter as a module, whose documentation is its text, and lists them. Links go to modules: their
/// targets in `links.txt` come before those of the chapter, which are files.
macro_rules! chapters {
    ($($name:ident)*) => {
        $(
            #[doc = include_str!("links.txt")]
            #[doc = include_str!(concat!(stringify!($name), ".md"))]
            pub mod $name {}
        )*
        /// All chapters, in the order of reading.
        #[doc(hidden)]
        pub const CHAPTERS: &[Chapter] = &[
            $(Chapter { name: stringify!($name), text: include_str!(concat!(stringify!($name), ".md")) }),*
        ];
    };
}

chapters! {
    tutorial
    loops
    scenes
    expressions
    methods
    stabilization
    accuracy
    kinematics
    studies
    linear
    flexible
    speed
    extremes
    simplify
    singular
    events
    results
    view
    troubleshooting
    rust
    python
    large
    gallery
    references
    changelog
}
