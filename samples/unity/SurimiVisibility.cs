// SPDX-License-Identifier: Apache-2.0
// Gives renderers the visibility map that surimi baked: one texture each, by MaterialPropertyBlock. The menu
// "Tools/Surimi/Set Up" (Editor/SurimiSetup.cs) fills it in; nothing is computed at run time. In a VRChat world it is
// an UdonSharpBehaviour.
using UnityEngine;
#if UDONSHARP
using UdonSharp;
#endif

#if UDONSHARP
[UdonBehaviourSyncMode(BehaviourSyncMode.None)]
[DefaultExecutionOrder(1000)] // after LTCGI's and Kanikama's own
public class SurimiVisibility : UdonSharpBehaviour
#else
[ExecuteAlways]
[DefaultExecutionOrder(1000)]
public class SurimiVisibility : MonoBehaviour
#endif
{
    public string texture; // property of the shader
    public string scaleOffset; // property, or empty
    public Renderer[] renderers;
    public Texture2D[] maps; // one a renderer
    public int[] submeshes; // -1: all of the renderer

    void Start()
    {
        Apply();
    }

    void OnEnable()
    {
        Apply();
    }

    public void Apply()
    {
        if (renderers == null || maps == null || submeshes == null) return;
        MaterialPropertyBlock block = new MaterialPropertyBlock();
        for (int i = 0; i < renderers.Length; i++)
        {
            Renderer one = renderers[i];
            if (one == null || maps[i] == null) continue;
            if (submeshes[i] < 0) one.GetPropertyBlock(block);
            else one.GetPropertyBlock(block, submeshes[i]);
            block.SetTexture(texture, maps[i]);
            // The map's UVs are places in the whole of it already.
            if (!string.IsNullOrEmpty(scaleOffset)) block.SetVector(scaleOffset, new Vector4(1, 1, 0, 0));
            if (submeshes[i] < 0) one.SetPropertyBlock(block);
            else one.SetPropertyBlock(block, submeshes[i]);
        }
    }
}
