"""Strongly connected components, the blocks of the block lower triangular form.

R. Tarjan, Depth-first search and linear graph algorithms, SIAM J. Comput. 1 (1972) 146-160.
"""

from __future__ import annotations

from collections.abc import Sequence


def strong_components(needs: Sequence[Sequence[int]]) -> list[list[int]]:
    """Components of the graph node -> needs[node], each after those that it needs; nodes ascending inside."""
    count = len(needs)
    number, low = [-1] * count, [0] * count
    on_stack, stack = [False] * count, []
    components: list[list[int]] = []
    counter = 0
    for root in range(count):
        if number[root] >= 0:
            continue
        work = [(root, iter(needs[root]))]
        number[root] = low[root] = counter
        counter += 1
        stack.append(root)
        on_stack[root] = True
        while work:
            node, remaining = work[-1]
            advanced = False
            for other in remaining:
                if number[other] < 0:
                    number[other] = low[other] = counter
                    counter += 1
                    stack.append(other)
                    on_stack[other] = True
                    work.append((other, iter(needs[other])))
                    advanced = True
                    break
                if on_stack[other]:
                    low[node] = min(low[node], number[other])
            if advanced:
                continue
            work.pop()
            if work:
                parent = work[-1][0]
                low[parent] = min(low[parent], low[node])
            if low[node] == number[node]:
                component = []
                while on_stack[node]:
                    component.append(stack.pop())
                    on_stack[component[-1]] = False
                components.append(sorted(component))
    return components
