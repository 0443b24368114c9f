-- No model at all: the text of separate.vs' scene from its union on, printed.
local count = tonumber(arg[1])
io.write("union {\n")
for j = 0, count - 1 do
  for i = 0, count - 1 do
    local x, y = 3 * i, 3 * j
    io.write("  cylinder { <", x, ", ", y, ", 0>, <", x, ", ", y, ", 2>, 1 }\n")
  end
end
io.write("}\n")
