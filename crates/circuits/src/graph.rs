//! Builds the directed graph of Sec. 3: a vertex for each pair that can impact, loops included.

use std::collections::BTreeMap;

/// The fully connected directed graph of N vertices, named for a chain of N − 1 masses.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Graph {
    labels: Vec<String>,
}

/// A circuit: vertex indices, read cyclically. Of its rotations the lexicographically least.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Circuit(Vec<usize>);

impl Graph {
    /// The graph of `masses` masses between walls: vertices L-1, 1-2, …, n-R; without masses L-R.
    pub fn of_chain(masses: usize) -> Self {
        let body = |j: usize| match j {
            0 => "L".to_string(),
            j if j > masses => "R".to_string(),
            j => j.to_string(),
        };
        Graph { labels: (0..=masses).map(|j| format!("{}-{}", body(j), body(j + 1))).collect() }
    }

    pub fn vertices(&self) -> usize {
        self.labels.len()
    }

    pub fn label(&self, vertex: usize) -> &str {
        &self.labels[vertex]
    }

    /// Every primitive circuit of at most `longest` edges, in lexicographic order: a circuit that
    /// only runs another one several times over is the same periodic orbit and is left out.
    ///
    /// There are about N^longest/longest of them. Their least rotations are the Lyndon words over
    /// the vertices, which Duval's algorithm lists in order.
    pub fn circuits(&self, longest: usize) -> impl Iterator<Item = Circuit> + use<> {
        let last = self.vertices() - 1;
        let first = (longest > 0).then(|| Circuit(vec![0]));
        std::iter::successors(first, move |circuit| {
            let mut word: Vec<usize> = circuit.0.iter().copied().cycle().take(longest).collect();
            while word.last() == Some(&last) {
                word.pop();
            }
            *word.last_mut()? += 1;
            Some(Circuit(word))
        })
    }
}

impl Circuit {
    /// The circuit of a cyclic sequence of vertices, in its least rotation.
    pub fn new(word: Vec<usize>) -> Self {
        let rotation = |i: usize| word[i..].iter().chain(&word[..i]).copied().collect::<Vec<_>>();
        Circuit((0..word.len()).map(rotation).min().unwrap_or_default())
    }

    /// Its vertices from the least rotation's start.
    pub fn word(&self) -> &[usize] {
        &self.0
    }

    /// Its number of edges, the paper's length.
    pub fn length(&self) -> usize {
        self.0.len()
    }

    /// How often each visited vertex occurs; their number is X, that of different impacts.
    pub fn visits(&self) -> BTreeMap<usize, usize> {
        let mut visits = BTreeMap::new();
        for vertex in &self.0 {
            *visits.entry(*vertex).or_insert(0) += 1;
        }
        visits
    }

    /// Returns whether it visits no vertex twice.
    pub fn is_simple(&self) -> bool {
        (1..self.0.len()).all(|place| !self.0[..place].contains(&self.0[place]))
    }

    /// Its class in Eq. (34): how many vertices are visited j + 1 times; empty if simple.
    pub fn repeats(&self) -> Vec<usize> {
        let visits = self.visits();
        let most = visits.values().copied().max().unwrap_or(1);
        (2..=most).map(|m| visits.values().filter(|v| **v == m).count()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circuits_of_two_vertices_by_hand() {
        let graph = Graph::of_chain(1);
        assert_eq!((graph.vertices(), [graph.label(0), graph.label(1)]), (2, ["L-1", "1-R"]));
        let words: Vec<Vec<usize>> = graph.circuits(3).map(|one| one.word().to_vec()).collect();
        assert_eq!(words, [vec![0], vec![0, 0, 1], vec![0, 1], vec![0, 1, 1], vec![1]]);
        let circuit = Circuit::new(vec![2, 0, 2, 1, 0, 2]);
        assert_eq!(circuit.word(), [0, 2, 1, 0, 2, 2]);
        assert_eq!((circuit.repeats(), circuit.is_simple()), (vec![1, 1], false));
        assert_eq!(circuit.visits(), BTreeMap::from([(0, 2), (1, 1), (2, 3)]));
    }
}
