local function make_tree(d) if d == 0 then return 1 end return { make_tree(d - 1), make_tree(d - 1) } end
local function walk(tree)
  if type(tree) == "table" then walk(tree[1]); walk(tree[2]) else coroutine.yield(tree) end
end
local tree, sum = make_tree(15), 0
for i = 1, 6 do
  for leaf in coroutine.wrap(function() walk(tree) end) do sum = sum + leaf end
end
print(sum)
