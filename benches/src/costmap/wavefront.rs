//! Inflation as Nav2 does it up to Kilted: a wavefront from all obstacles, nearest cells first, each with
//! the obstacle that it came from, and a list of cells for each distance. Written from the description in
//! `inflation_layer.cpp`.

/// A cell in the wavefront and the obstacle that it came from.
#[derive(Clone, Copy)]
struct Front {
    square: u32,
    x: u16,
    y: u16,
    from_x: u16,
    from_y: u16,
}

/// Raises the costs around lethal cells; `table` has costs by squared distance.
pub(crate) fn inflate(cells: &mut [u8], width: usize, table: &[u8]) {
    let height = cells.len() / width;
    let mut seen = vec![false; cells.len()];
    let mut bins: Vec<Vec<Front>> = vec![Vec::new(); table.len()];
    let start = |x: usize, y: usize| {
        let (x, y) = (x as u16, y as u16);
        Front { square: 0, x, y, from_x: x, from_y: y }
    };
    for (index, _) in cells.iter().enumerate().filter(|(_, cost)| **cost == 254) {
        bins[0].push(start(index % width, index / width));
    }
    let mut visit = |front: Front, push: &mut dyn FnMut(Front)| {
        let index = usize::from(front.y) * width + usize::from(front.x);
        if std::mem::replace(&mut seen[index], true) {
            return;
        }
        cells[index] = cells[index].max(table[front.square as usize]);
        for (dx, dy) in [(-1_i32, 0_i32), (0, -1), (1, 0), (0, 1)] {
            let (x, y) = (i32::from(front.x) + dx, i32::from(front.y) + dy);
            if x < 0 || y < 0 || x >= width as i32 || y >= height as i32 {
                continue;
            }
            if seen[y as usize * width + x as usize] {
                continue;
            }
            let (far_x, far_y) = (x - i32::from(front.from_x), y - i32::from(front.from_y));
            let square = (far_x * far_x + far_y * far_y) as u32;
            if (square as usize) < table.len() {
                push(Front { square, x: x as u16, y: y as u16, ..front });
            }
        }
    };
    for bin in 0..bins.len() {
        let mut next = 0;
        while let Some(&front) = bins[bin].get(next) {
            next += 1;
            // A cell never comes into a bin before its own.
            visit(front, &mut |ahead| bins[(ahead.square as usize).max(bin)].push(ahead));
        }
    }
}
