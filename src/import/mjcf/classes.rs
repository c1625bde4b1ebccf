//! Default classes of elements.

use crate::error::{Error, Result};
use crate::import::xml::{Element, all, place};
use roxmltree::Node;
use std::collections::HashMap;

/// Default classes: the `<default>`s of each, its own first, then those around it.
pub struct Classes<'a, 'i> {
    chains: HashMap<&'a str, Vec<Node<'a, 'i>>>,
}

/// The class of elements that name none.
const MAIN: &str = "main";

impl<'a, 'i> Classes<'a, 'i> {
    pub fn read(root: Node<'a, 'i>) -> Self {
        let mut classes = Classes { chains: HashMap::new() };
        let mut pending: Vec<(Node, Vec<Node>)> = all(root, "default").map(|node| (node, Vec::new())).collect();
        while let Some((node, around)) = pending.pop() {
            let chain = [vec![node], around].concat();
            pending.extend(all(node, "default").map(|inner| (inner, chain.clone())));
            // The outermost class is that of all elements, whatever its name.
            let name = node.attribute("class").filter(|_| chain.len() > 1).unwrap_or(MAIN);
            if let Some(own) = node.attribute("class").filter(|_| name == MAIN) {
                classes.chains.entry(own).or_default().extend(&chain);
            }
            classes.chains.entry(name).or_default().extend(chain);
        }
        classes
    }

    /// The element with its defaults under these tags; `class` is that of the bodies around it.
    pub fn element(&self, node: Node<'a, 'i>, tags: &[&str], class: Option<&'a str>) -> Result<Element<'a, 'i>> {
        let class = node.attribute("class").or(class).unwrap_or(MAIN);
        let Some(chain) = self.chains.get(class) else {
            if class == MAIN {
                return Ok(Element { node, defaults: Vec::new() });
            }
            let mut known: Vec<&str> = self.chains.keys().copied().collect();
            known.sort_unstable();
            return Err(Error::unknown("default class", class, known).placed(place(node)));
        };
        let of_class = |class: &Node<'a, 'i>| -> Vec<Node<'a, 'i>> {
            class.children().rev().filter(|child| tags.contains(&child.tag_name().name())).collect()
        };
        Ok(Element { node, defaults: chain.iter().flat_map(of_class).collect() })
    }
}
