//! A graph cut into parts of about equal size that nothing couples but a few nodes, the separator.

use crate::tolerances;

/// The part of nodes of the separator: the last in any comparison.
pub const SEPARATOR: u32 = u32::MAX;

/// The part of each node, by the nodes that each is coupled to, and the number of parts: `most` of them, or half as many
/// and so on, until at most `largest` nodes are in the separator; `None` if even two parts have more.
///
/// By halves: with nodes in the order of their distance from one at the rim, those at one distance separate the nearer
/// from the farther ones. In chains, trees and rows of loops these are few. Nodes that are coupled to very many belong
/// to the separator first.
pub fn divide(neighbours: &[Vec<u32>], most: usize, largest: usize) -> Option<(Vec<u32>, usize)> {
    let many = tolerances::LARGEST_SEPARATOR.max(4 * neighbours.len().isqrt());
    let (hubs, nodes): (Vec<u32>, Vec<u32>) =
        (0..neighbours.len() as u32).partition(|&node| neighbours[node as usize].len() > many);
    let is_small = |part: &[u32]| part.iter().filter(|part| **part == SEPARATOR).count() <= largest;
    let counts = std::iter::successors(Some(most), |count| Some(count / 2)).take_while(|count| *count > 1);
    let mut divisions = counts.map(|count| {
        let mut graph = Graph { neighbours, part: vec![0; neighbours.len()], distance: vec![UNSEEN; neighbours.len()] };
        hubs.iter().for_each(|&node| graph.part[node as usize] = SEPARATOR);
        graph.halve(nodes.clone(), 0, count as u32);
        (graph.part, count)
    });
    divisions.find(|(part, _)| is_small(part))
}

const UNSEEN: u32 = u32::MAX;

struct Graph<'a> {
    neighbours: &'a [Vec<u32>],
    part: Vec<u32>,
    distance: Vec<u32>,
}

impl Graph<'_> {
    /// Divides the nodes of part `first` into `count` parts.
    fn halve(&mut self, nodes: Vec<u32>, first: u32, count: u32) {
        if count < 2 || nodes.is_empty() {
            return;
        }
        let start = self.by_distance(&nodes, nodes[0]).pop().unwrap_or(nodes[0]);
        let order = self.by_distance(&nodes, start);
        let cut = self.cut(&order);
        let second = first + count / 2;
        for &node in &order {
            let distance = self.distance[node as usize];
            self.part[node as usize] = match distance.cmp(&cut) {
                std::cmp::Ordering::Less => first,
                std::cmp::Ordering::Equal if !self.reaches_beyond(node, cut) => first,
                std::cmp::Ordering::Equal => SEPARATOR,
                std::cmp::Ordering::Greater => second,
            };
        }
        let of = |part: u32| order.iter().copied().filter(|&node| self.part[node as usize] == part).collect();
        let [near, far]: [Vec<u32>; 2] = [of(first), of(second)];
        self.halve(near, first, count / 2);
        self.halve(far, second, count - count / 2);
    }

    /// The nodes in the order of their distance from `start`; those that it does not reach come behind, from others.
    fn by_distance(&mut self, nodes: &[u32], start: u32) -> Vec<u32> {
        let part = self.part[start as usize];
        nodes.iter().for_each(|&node| self.distance[node as usize] = UNSEEN);
        let mut order: Vec<u32> = Vec::with_capacity(nodes.len());
        for &begin in std::iter::once(&start).chain(nodes) {
            if self.distance[begin as usize] != UNSEEN {
                continue;
            }
            let farthest = order.last().map_or(0, |&last| self.distance[last as usize] + 1);
            self.distance[begin as usize] = farthest;
            let mut next = order.len();
            order.push(begin);
            while let Some(&node) = order.get(next) {
                next += 1;
                for &other in &self.neighbours[node as usize] {
                    if self.part[other as usize] == part && self.distance[other as usize] == UNSEEN {
                        self.distance[other as usize] = self.distance[node as usize] + 1;
                        order.push(other);
                    }
                }
            }
        }
        order
    }

    /// The distance about the middle at which the fewest nodes are coupled to farther ones.
    fn cut(&self, order: &[u32]) -> u32 {
        let at = |tenths: usize| self.distance[order[(tenths * order.len() / 10).min(order.len() - 1)] as usize];
        let mut width = vec![0_usize; (at(6) - at(4)) as usize + 1];
        for &node in order {
            let distance = self.distance[node as usize];
            if (at(4)..=at(6)).contains(&distance) && self.reaches_beyond(node, distance) {
                width[(distance - at(4)) as usize] += 1;
            }
        }
        let middle = width.len() / 2;
        let fewest = (0..width.len()).min_by_key(|&k| (width[k], k.abs_diff(middle)));
        at(4) + fewest.unwrap_or(0) as u32
    }

    /// True if a node is coupled to one that is farther than its own distance.
    fn reaches_beyond(&self, node: u32, distance: u32) -> bool {
        let is_farther = |other: usize| self.part[other] != SEPARATOR && self.distance[other] == distance + 1;
        self.neighbours[node as usize].iter().any(|&other| is_farther(other as usize))
    }
}
