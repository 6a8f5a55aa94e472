//! Sparse Cholesky factorization in blocks of three by three.

/// A block, row by row.
pub(crate) type Block = [f64; 9];

/// The lower half of a symmetric matrix of blocks, and then its factor: column by column the rows
/// below the diagonal, in order.
pub(crate) struct Factor {
    diagonal: Vec<Block>,
    starts: Vec<u32>,
    rows: Vec<u32>,
    blocks: Vec<Block>,
}

impl Factor {
    /// Room for the factor of a matrix whose columns have blocks in these rows below the diagonal
    /// (in any order, repeated or not).
    pub(crate) fn new(below: &[Vec<u32>]) -> Self {
        let size = below.len();
        let mut columns: Vec<Vec<u32>> = Vec::with_capacity(size);
        let mut children: Vec<Vec<u32>> = vec![Vec::new(); size];
        let mut seen = vec![u32::MAX; size];
        for (column, own) in below.iter().enumerate() {
            // Elimination of a column joins all rows in it: they fill the column of the first.
            let mut rows: Vec<u32> = Vec::new();
            let mut take = |row: u32| {
                if row as usize > column && seen[row as usize] != column as u32 {
                    seen[row as usize] = column as u32;
                    rows.push(row);
                }
            };
            own.iter().copied().for_each(&mut take);
            for &child in &children[column] {
                columns[child as usize].iter().copied().for_each(&mut take);
            }
            rows.sort_unstable();
            if let Some(&parent) = rows.first() {
                children[parent as usize].push(column as u32);
            }
            columns.push(rows);
        }
        let mut starts = Vec::with_capacity(size + 1);
        let mut rows = Vec::new();
        for column in &columns {
            starts.push(rows.len() as u32);
            rows.extend_from_slice(column);
        }
        starts.push(rows.len() as u32);
        let blocks = vec![[0.0; 9]; rows.len()];
        Self { diagonal: vec![[0.0; 9]; size], starts, rows, blocks }
    }

    /// Nothing in any block.
    pub(crate) fn clear(&mut self) {
        self.diagonal.fill([0.0; 9]);
        self.blocks.fill([0.0; 9]);
    }

    /// The block on the diagonal.
    pub(crate) fn diagonal(&mut self, at: usize) -> &mut Block {
        &mut self.diagonal[at]
    }

    /// The block at a row below the diagonal; it must be one that was asked for.
    pub(crate) fn block(&mut self, row: usize, column: usize) -> &mut Block {
        let start = self.starts[column] as usize;
        let end = self.starts[column + 1] as usize;
        let place = self.rows[start..end].partition_point(|&it| (it as usize) < row);
        &mut self.blocks[start + place]
    }

    /// Columns.
    pub(crate) fn len(&self) -> usize {
        self.diagonal.len()
    }

    /// Factorizes columns from the first that is not yet done up to some column or until a number of block
    /// products is reached. Returns the first column left; `None` if the matrix is not positive definite.
    pub(crate) fn factorize(&mut self, from: usize, until: usize, most: usize) -> Option<usize> {
        let mut done = 0;
        for column in from..until {
            if done > most {
                return Some(column);
            }
            let l = lower(&self.diagonal[column])?;
            self.diagonal[column] = l;
            let (start, end) = (self.starts[column] as usize, self.starts[column + 1] as usize);
            done += 1 + (end - start) * (end - start + 1) / 2;
            for block in &mut self.blocks[start..end] {
                divide(block, &l);
            }
            // What this column takes from all to its right.
            for first in start..end {
                let row = self.rows[first] as usize;
                let left = self.blocks[first];
                subtract_square(&mut self.diagonal[row], &left);
                let mut place = self.starts[row] as usize;
                for second in first + 1..end {
                    let wanted = self.rows[second];
                    while self.rows[place] != wanted {
                        place += 1;
                    }
                    let other = self.blocks[second];
                    subtract_product(&mut self.blocks[place], &other, &left);
                }
            }
        }
        Some(until)
    }

    /// Solves for a right side, in place, with the factor.
    pub(crate) fn solve(&self, values: &mut [[f64; 3]]) {
        for column in 0..self.diagonal.len() {
            let l = &self.diagonal[column];
            let x = forward(l, values[column]);
            values[column] = x;
            let (start, end) = (self.starts[column] as usize, self.starts[column + 1] as usize);
            for place in start..end {
                let b = &self.blocks[place];
                let target = &mut values[self.rows[place] as usize];
                for i in 0..3 {
                    target[i] -= b[3 * i] * x[0] + b[3 * i + 1] * x[1] + b[3 * i + 2] * x[2];
                }
            }
        }
        for column in (0..self.diagonal.len()).rev() {
            let mut x = values[column];
            let (start, end) = (self.starts[column] as usize, self.starts[column + 1] as usize);
            for place in start..end {
                let b = &self.blocks[place];
                let y = values[self.rows[place] as usize];
                for (j, sum) in x.iter_mut().enumerate() {
                    *sum -= b[j] * y[0] + b[3 + j] * y[1] + b[6 + j] * y[2];
                }
            }
            values[column] = backward(&self.diagonal[column], x);
        }
    }
}

/// The lower factor of a block.
fn lower(m: &Block) -> Option<Block> {
    let a = m[0];
    if !(a > 0.0 && a.is_finite()) {
        return None;
    }
    let l00 = a.sqrt();
    let (l10, l20) = (m[3] / l00, m[6] / l00);
    let b = m[4] - l10 * l10;
    if !(b > 0.0 && b.is_finite()) {
        return None;
    }
    let l11 = b.sqrt();
    let l21 = (m[7] - l20 * l10) / l11;
    let c = m[8] - l20 * l20 - l21 * l21;
    if !(c > 0.0 && c.is_finite()) {
        return None;
    }
    Some([l00, 0.0, 0.0, l10, l11, 0.0, l20, l21, c.sqrt()])
}

/// block · l⁻ᵀ.
fn divide(block: &mut Block, l: &Block) {
    for row in block.chunks_exact_mut(3) {
        row[0] /= l[0];
        row[1] = (row[1] - row[0] * l[3]) / l[4];
        row[2] = (row[2] - row[0] * l[6] - row[1] * l[7]) / l[8];
    }
}

/// target -= a · aᵀ.
fn subtract_square(target: &mut Block, a: &Block) {
    subtract_product(target, a, a);
}

/// target -= a · bᵀ.
#[inline]
fn subtract_product(target: &mut Block, a: &Block, b: &Block) {
    for i in 0..3 {
        for j in 0..3 {
            target[3 * i + j] -=
                a[3 * i] * b[3 * j] + a[3 * i + 1] * b[3 * j + 1] + a[3 * i + 2] * b[3 * j + 2];
        }
    }
}

fn forward(l: &Block, b: [f64; 3]) -> [f64; 3] {
    let x = b[0] / l[0];
    let y = (b[1] - l[3] * x) / l[4];
    [x, y, (b[2] - l[6] * x - l[7] * y) / l[8]]
}

fn backward(l: &Block, b: [f64; 3]) -> [f64; 3] {
    let z = b[2] / l[8];
    let y = (b[1] - l[7] * z) / l[4];
    [(b[0] - l[3] * y - l[6] * z) / l[0], y, z]
}
