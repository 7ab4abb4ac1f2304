// Sums over the invocations of a workgroup, in rounds of doubling reach (Hillis & Steele 1986): two barriers a round. They are of u32 and
// wrap. All invocations of the workgroup must call them together.

#define_import_path cutaway::sums

var<workgroup> reached: array<u32, 256>;

// The sum of the values of the preceding invocations, and the total, in a workgroup of 2^rounds invocations, 256 at most.
fn sums_before(value: u32, invocation: u32, rounds: u32) -> vec2<u32> {
    reached[invocation] = value;
    workgroupBarrier();
    for (var round = 0u; round < rounds; round++) {
        let reach = 1u << round;
        var sum = reached[invocation];
        if invocation >= reach {
            sum += reached[invocation - reach];
        }
        workgroupBarrier();
        reached[invocation] = sum;
        workgroupBarrier();
    }
    return vec2<u32>(reached[invocation] - value, reached[(1u << rounds) - 1u]);
}
