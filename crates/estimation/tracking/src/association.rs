//! Nearest-neighbour association.

/// Assigns each row to at most one column and each column to at most one row: the smallest distances first, none above
/// the gate. Returns the column of each row. Equal distances are assigned by row, then column.
pub(crate) fn nearest_neighbours(
    rows: usize,
    columns: usize,
    gate: f64,
    distance: impl Fn(usize, usize) -> f64,
) -> Vec<Option<usize>> {
    let mut candidates = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let apart = distance(row, column);
            if apart <= gate {
                candidates.push((apart, row, column));
            }
        }
    }
    candidates.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let (mut of_row, mut is_taken) = (vec![None; rows], vec![false; columns]);
    for (_, row, column) in candidates {
        if of_row[row].is_none() && !is_taken[column] {
            of_row[row] = Some(column);
            is_taken[column] = true;
        }
    }
    of_row
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second row is nearer to the only column of the first; that of distance 9 is beyond the gate.
    #[test]
    fn the_nearest_pairs_win() {
        let distances = [[2.0, 9.0], [1.0, 4.0], [5.0, 3.0]];
        let assigned = nearest_neighbours(3, 2, 6.0, |row, column| distances[row][column]);
        assert_eq!(assigned, [None, Some(0), Some(1)]);
    }
}
