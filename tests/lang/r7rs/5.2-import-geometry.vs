(import (scheme base))
(make-box origin (xyz 1 1 1))   ; expect error: make-box is not defined; (import (visualscheme)) brings it
