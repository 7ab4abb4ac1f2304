// Resets the words of all lists to zero. One invocation owns one list.

#import cutaway::fragment_pool::pool
#import cutaway::sweep::number_of

@group(1) @binding(4) var<storage, read_write> fragments: array<u32>;

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) id: vec3<u32>) {
    let list = number_of(id);
    if list < pool.lists {
        fragments[list] = 0u;
    }
}
