//! Elements and attributes of XML, with their places in errors.

use crate::error::{Error, Result, excerpt};
use crate::scene::locate::line_and_column;
use roxmltree::{Document, Node};
use std::borrow::Cow;
use std::collections::HashSet;

/// The text with blanks in the place of an XML declaration that does not come first, as XML asks; places stay.
pub fn without_late_declaration(text: &str) -> Cow<'_, str> {
    let body = text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}');
    let start = text.len() - body.len();
    match body.find("?>").filter(|_| start > 0 && body.starts_with("<?xml ")) {
        None => Cow::Borrowed(text),
        Some(end) => {
            let blank = " ".repeat(end + 2);
            Cow::Owned([&text[..start], &blank, &body[end + 2..]].concat())
        }
    }
}

pub fn document(text: &str) -> Result<Document<'_>> {
    Document::parse(text).map_err(|error| {
        let at = error.pos();
        Error::input(format!("this is not XML: {error}")).placed((at.row as usize, at.col as usize))
    })
}

/// Line and column of a node.
pub fn place(node: Node) -> (usize, usize) {
    line_and_column(node.document().input_text(), node.range().start)
}

/// An error at a node.
pub fn faulty(node: Node, message: impl Into<String>) -> Error {
    Error::input(message).placed(place(node))
}

/// Names of the elements in a node that are not among the `used` ones, each once.
pub fn unused(node: Node, used: &[&str]) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut known = HashSet::new();
    for tag in node.children().filter(Node::is_element).map(|node| node.tag_name().name()) {
        if !used.contains(&tag) && known.insert(tag) {
            names.push(tag.to_string());
        }
    }
    names
}

/// The children of this tag.
pub fn all<'a, 'i>(node: Node<'a, 'i>, tag: &'static str) -> impl Iterator<Item = Node<'a, 'i>> {
    node.children().filter(move |child| child.has_tag_name(tag))
}

/// The first child of this tag.
pub fn child<'a, 'i>(node: Node<'a, 'i>, tag: &str) -> Option<Node<'a, 'i>> {
    node.children().find(|child| child.has_tag_name(tag))
}

/// The text of an attribute that must be there.
pub fn attribute<'a>(node: Node<'a, '_>, key: &str) -> Result<&'a str> {
    node.attribute(key).ok_or_else(|| lacking(node, key))
}

fn lacking(node: Node, key: &str) -> Error {
    faulty(node, format!("<{}> has no `{key}`", node.tag_name().name()))
}

/// The texts of an attribute of these nodes, each once in a row.
pub fn texts<'a, 'i: 'a>(nodes: impl Iterator<Item = Node<'a, 'i>>, key: &str) -> Vec<String> {
    let mut texts: Vec<String> = nodes.filter_map(|node| node.attribute(key).map(str::to_string)).collect();
    texts.dedup();
    texts
}

/// An element whose missing attributes are those of others.
pub struct Element<'a, 'i> {
    pub node: Node<'a, 'i>,
    pub defaults: Vec<Node<'a, 'i>>,
}

impl<'a, 'i> Element<'a, 'i> {
    /// An element that has no defaults.
    pub fn plain(node: Node<'a, 'i>) -> Self {
        Element { node, defaults: Vec::new() }
    }

    /// What all children of this tag say together; of an attribute the last one that has it.
    pub fn merged(parent: Node<'a, 'i>, tag: &str) -> Self {
        let defaults = parent.children().rev().filter(|child| child.has_tag_name(tag)).collect();
        Element { node: parent, defaults }
    }

    /// The text of an attribute, with the node that has it.
    pub fn found(&self, key: &str) -> Option<(Node<'a, 'i>, &'a str)> {
        let all = std::iter::once(&self.node).chain(&self.defaults);
        all.filter_map(|node| Some((*node, node.attribute(key)?))).next()
    }

    pub fn text(&self, key: &str) -> Option<&'a str> {
        self.found(key).map(|(_, text)| text)
    }

    pub fn is(&self, key: &str, value: &str) -> bool {
        self.text(key) == Some(value)
    }

    pub fn number(&self, key: &str) -> Result<Option<f64>> {
        self.found(key).map(|(node, text)| parsed(node, key, text)).transpose()
    }

    pub fn number_or(&self, key: &str, default: f64) -> Result<f64> {
        Ok(self.number(key)?.unwrap_or(default))
    }

    /// A number that must be there.
    pub fn needed(&self, key: &str) -> Result<f64> {
        self.number(key)?.ok_or_else(|| lacking(self.node, key))
    }

    /// The numbers of an attribute; none where it is not given.
    pub fn list(&self, key: &str) -> Result<Vec<f64>> {
        self.found(key).map_or(Ok(Vec::new()), |(node, text)| list(node, key, text))
    }

    /// The first number of an attribute.
    pub fn first_or(&self, key: &str, default: f64) -> Result<f64> {
        Ok(self.list(key)?.first().copied().unwrap_or(default))
    }

    /// True if one of the numbers of an attribute is not zero.
    pub fn has(&self, key: &str) -> Result<bool> {
        Ok(self.list(key)?.iter().any(|x| *x != 0.0))
    }

    pub fn numbers<const N: usize>(&self, key: &str) -> Result<Option<[f64; N]>> {
        self.found(key).map(|(node, text)| exactly(node, key, list(node, key, text)?)).transpose()
    }

    pub fn numbers_or<const N: usize>(&self, key: &str, default: [f64; N]) -> Result<[f64; N]> {
        Ok(self.numbers(key)?.unwrap_or(default))
    }
}

/// The number of a word in an attribute.
fn parsed(node: Node, key: &str, text: &str) -> Result<f64> {
    let value = text.trim().parse().ok().filter(|value: &f64| value.is_finite());
    value.ok_or_else(|| faulty(node, format!("expected a number in `{key}`, found \"{}\"", excerpt(text))))
}

pub fn list(node: Node, key: &str, text: &str) -> Result<Vec<f64>> {
    text.split_whitespace().map(|word| parsed(node, key, word)).collect()
}

fn exactly<const N: usize>(node: Node, key: &str, all: Vec<f64>) -> Result<[f64; N]> {
    all.try_into()
        .map_err(|all: Vec<f64>| faulty(node, format!("expected {N} numbers in `{key}`, found {}", all.len())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_declaration_after_blanks_is_read_and_places_stay() {
        let text = "\n <?xml version=\"1.0\"?>\n<a><b/></a>";
        let text = without_late_declaration(text);
        let document = document(&text).unwrap();
        assert_eq!(place(document.root_element().first_child().unwrap()), (3, 4));
        assert!(matches!(without_late_declaration("<?xml version=\"1.0\"?><a/>"), Cow::Borrowed(_)));
    }
}
