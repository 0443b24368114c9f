local function make(depth)
  if depth == 0 then return { false, false } end
  return { make(depth - 1), make(depth - 1) }
end
local function check(tree) if tree[1] then return 1 + check(tree[1]) + check(tree[2]) end return 1 end
local function run(n)
  local long, sum = make(n), 0
  for depth = 4, n, 2 do
    for i = 1, 1 << (n - depth) do sum = sum + check(make(depth)) end
  end
  return sum + check(long)
end
print(run(15))
